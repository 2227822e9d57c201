// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <functional>

#include "assembly/plan.hpp"
#include "sampling/sample.hpp"
#include "scene/initial_state.hpp"
#include "step/simulation.hpp"

/// Small scenes built by hand, for tests of effects and of the step loop.
namespace tripoint::lab {

struct Block {
  std::string name = "block";
  std::size_t material = 0;
  Vec3 corner{};                      ///< centre of the first particle [m]
  std::array<int, 3> count{1, 1, 1};  ///< particles along x, y, z
  Phase phase = Phase::rigid;
  Motion motion = Motion::free;
  Vec3 velocity{}, angular_velocity{};  ///< [m/s], [rad/s]
  std::function<double(const Vec3&)> temperature{};
  bool temperature_held = false;
};

/// Diffusivity of material 0 of a lab as it comes [m2/s].
inline constexpr double diffusivity = 1e-6;

struct Lab {
  Scene scene;
  InitialState initial;

  explicit Lab(double spacing, Mode mode = Mode::corrected) {
    scene.spacing = spacing;
    scene.end_time = 1.0;
    set_mode(mode);
    add_material(1000.0, 1.0, 1000.0);
  }
  void set_mode(Mode mode) {
    scene.mode = mode;
    scene.set_all_modes(mode);
    scene.support_ratio = mode == Mode::paper ? 2.12 : 2.6;
  }
  void add_material(double density, double conductivity, double heat_capacity) {
    Material m;
    m.name = "m" + std::to_string(scene.materials.size());
    m.density = density;
    m.conductivity = conductivity;
    m.heat_capacity = heat_capacity;
    m.solid = SolidKind::rigid;
    scene.materials.push_back(m);
  }
  /// Domain from corner - dx/2, periodic where asked; elsewhere so wide that nothing leaves it.
  void make_periodic(const std::array<bool, 3>& periodic, const Vec3& corner,
                     const std::array<int, 3>& count) {
    const double dx = scene.spacing;
    scene.periodic = periodic;
    scene.min = corner - Vec3{0.5 * dx, 0.5 * dx, 0.5 * dx};
    scene.max = *scene.min + Vec3{count[0] * dx, count[1] * dx, count[2] * dx};
    for (std::size_t a = 0; a < 3; ++a)
      if (!periodic[a]) {
        (*scene.min)[a] -= 1e6 * dx;
        (*scene.max)[a] += 1e6 * dx;
      }
  }
  /// A body of particles at any places; their velocities are those of rigid motion.
  void add_points(const Block& b, const std::vector<Vec3>& points, double mass) {
    Body body;
    body.name = b.name;
    body.material = scene.materials[b.material].name;
    body.phase = b.phase;
    body.motion = b.motion;
    body.velocity.value = b.velocity;
    body.angular_velocity = b.angular_velocity;
    body.temperature_held = b.temperature_held;
    if (b.temperature) body.temperature.emplace();
    const int source = static_cast<int>(scene.bodies.size());
    scene.bodies.push_back(body);
    Vec3 centre;
    for (const Vec3& r : points) centre += r / static_cast<double>(points.size());
    for (const Vec3& r : points) {
      initial.position.push_back(r);
      initial.velocity.push_back(
          b.motion == Motion::fixed ? Vec3{} : b.velocity + cross(b.angular_velocity, r - centre));
      initial.mass.push_back(mass);
      if (b.temperature) initial.temperature.push_back(b.temperature(r));
      initial.phase.push_back(static_cast<int>(b.phase));
      initial.body.push_back(body_rows(scene).back());
      initial.material.push_back(static_cast<int>(b.material));
      initial.source.push_back(source);
    }
  }
  void add(const Block& b) {
    std::vector<Vec3> points;
    for (int z = 0; z < b.count[2]; ++z) {
      for (int y = 0; y < b.count[1]; ++y) {
        for (int x = 0; x < b.count[0]; ++x)
          points.push_back(b.corner + scene.spacing * Vec3{double(x), double(y), double(z)});
      }
    }
    add_points(b, points,
               scene.materials[b.material].density * scene.spacing * scene.spacing * scene.spacing);
  }
  [[nodiscard]] Simulation run(double time, int threads = 1) const {
    Simulation s(scene, initial, {.threads = threads});
    s.advance_to(time);
    return s;
  }
};

/// Whether a plan has a column of this name.
inline bool lists(const Plan& p, std::string_view field) {
  return std::ranges::find(p.fields, field, &PlannedField::name) != p.fields.end();
}

/// A column by id.
inline std::vector<double> by_id(const Simulation& s, const Field<double>& f) {
  const Particles& p = s.state().particles;
  std::vector<double> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = p[f][p.row(id)];
  return values;
}

/// The block of 10 x 6 x 4 particles, spacing 0.1 m, mass 1 kg: I = (0.0416667, 0.095, 0.1116667) kg m2.
inline Lab asymmetric_block(const Vec3& angular_velocity, Mode mode = Mode::corrected) {
  Lab lab(0.1, mode);
  lab.scene.materials[0].density = 1.0 / (240.0 * 1e-3);
  lab.add({.corner = {-0.45, -0.25, -0.15}, .count = {10, 6, 4}, .angular_velocity = angular_velocity});
  return lab;
}

}  // namespace tripoint::lab
