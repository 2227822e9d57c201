// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "files/job.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/rigid_body.hpp"

/// Jobs and particles for the tests of references and metrics, made by hand: no reader, no sampler.
namespace tripoint::test {

inline constexpr double pi = std::numbers::pi;

struct Prepared {
  Job job;
  InitialState initial;
};

struct Lattice {
  std::array<int, 3> count{4, 4, 4};
  double spacing = 0.1;  ///< [m]
  Vec3 first;            ///< low corner of the box; particles are at cell centres [m]
  double mass = 1.0;     ///< of the body [kg]
};

struct Spin {
  Vec3 velocity, angular_velocity;  ///< [m/s], [rad/s]
};

/// Adds a rigid lattice body with its particles in rigid motion.
inline void add_body(Prepared& s, const std::string& name, const Lattice& l, const Spin& spin,
                     Motion motion = Motion::free) {
  const int index = static_cast<int>(s.job.bodies.size());
  std::vector<std::size_t> members;
  const auto n = static_cast<double>(l.count[0] * l.count[1] * l.count[2]);
  for (int i = 0; i < l.count[0]; ++i)
    for (int j = 0; j < l.count[1]; ++j)
      for (int k = 0; k < l.count[2]; ++k) {
        members.push_back(s.initial.size());
        s.initial.position.push_back(l.first + l.spacing * Vec3{i + 0.5, j + 0.5, k + 0.5});
        s.initial.velocity.push_back({});
        s.initial.mass.push_back(l.mass / n);
        s.initial.phase.push_back(static_cast<int>(Phase::rigid));
        s.initial.body.push_back(index);
        s.initial.material.push_back(0);
        s.initial.source.push_back(index);
      }
  const auto made = rigid_body(members, s.initial.position, s.initial.velocity, s.initial.mass);
  for (const auto i : members)
    s.initial.velocity[i] = spin.velocity + cross(spin.angular_velocity, s.initial.position[i] - made.centre);
  JobBody body;
  body.name = name;
  body.material = "block";
  body.index = index;
  body.motion = motion;
  body.velocity = spin.velocity;
  body.angular_velocity = spin.angular_velocity;
  body.properties = {made.mass, made.centre, made.inertia, made.axes};
  s.job.bodies.push_back(body);
  Body scene_body;
  scene_body.name = name;
  scene_body.material = "block";
  scene_body.phase = Phase::rigid;
  scene_body.motion = motion;
  scene_body.shape.min = l.first;
  scene_body.shape.max =
      l.first + l.spacing * Vec3{double(l.count[0]), double(l.count[1]), double(l.count[2])};
  s.job.scene.bodies.push_back(scene_body);
}

inline void set_times(Prepared& s, double end, int frames) {
  s.job.scene.end_time = end;
  s.job.times.clear();
  for (int n = 0; n <= frames; ++n) s.job.times.push_back(end * n / frames);
}

/// The block of 4 x 6 x 10 particles of the rigid notes: I = (0.0416667, 0.095, 0.1116667) kg m2.
inline Prepared block(const Vec3& angular_velocity, double end, int frames) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  add_body(s, "block", {{4, 6, 10}, 0.1, {-0.2, -0.3, -0.5}, 1.0}, {{}, angular_velocity});
  set_times(s, end, frames);
  return s;
}

/// A bar of one conducting material, count cells of one spacing, at temperatures f(position).
template <class F>
Prepared bar(const std::array<int, 3>& count, double spacing, F temperature, double end, int frames,
             bool periodic) {
  Prepared s;
  s.job.scene.spacing = s.job.resolution.spacing = spacing;
  Material m;
  m.name = "block";
  m.density = 1000.0;
  m.conductivity = 2.0;
  m.heat_capacity = 1000.0;  // D = 2e-6 m2/s
  s.job.scene.materials.push_back(m);
  add_body(s, "bar", {count, spacing, {}, 1000.0 * std::pow(spacing, 3) * count[0] * count[1] * count[2]},
           {});
  for (const auto& r : s.initial.position) s.initial.temperature.push_back(temperature(r));
  if (periodic) {
    s.job.scene.periodic = {true, true, true};
    s.job.scene.min = Vec3{};
    s.job.scene.max = spacing * Vec3{double(count[0]), double(count[1]), double(count[2])};
  }
  set_times(s, end, frames);
  return s;
}

inline ReferenceChoice function(const std::string& name, const Settings& args = {}) {
  ReferenceChoice choice;
  choice.function = name;
  choice.args = args;
  return choice;
}
inline std::unique_ptr<Reference> made(const Prepared& s, const std::string& name,
                                       const Settings& args = {}) {
  return make_reference(function(name, args), s.job, s.initial);
}

}  // namespace tripoint::test
