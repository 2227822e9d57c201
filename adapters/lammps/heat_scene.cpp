// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/heat_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/geometry.hpp"
#include "scene/phase_values.hpp"

namespace tripoint::lammps {
namespace {

std::string moving(const Job& job) {
  for (const JobBody& b : job.bodies) {
    if (norm(b.velocity) > 0.0 || norm(b.angular_velocity) > 0.0 || !b.keyframes.empty())
      return fmt::format("heat is run in LAMMPS at rest, and {} moves", b.name);
    if (b.motion == Motion::free && norm(job.scene.gravity) > 0.0)
      return fmt::format("heat is run in LAMMPS at rest, and {} is free to fall", b.name);
  }
  for (const Body& b : job.scene.bodies)
    if (b.velocity.kind != VelocityField::Kind::constant || norm(b.velocity.value) > 0.0)
      return fmt::format("heat is run in LAMMPS at rest, and {} has a velocity field", b.name);
  return {};
}

}  // namespace

std::string changing_phase(const Scene& scene) {
  double least = INFINITY, greatest = -INFINITY;
  for (const Body& b : scene.bodies) {
    if (!b.temperature || b.temperature->kind == TemperatureField::Kind::expression) continue;
    const Range r = range_of(*b.temperature, {});
    least = std::min(least, r.least);
    greatest = std::max(greatest, r.greatest);
  }
  for (const Event& e : scene.events)
    if (e.temperature) {
      least = std::min(least, *e.temperature);
      greatest = std::max(greatest, *e.temperature);
    }
  for (const Material& m : scene.materials)
    for (const auto& t : {m.t_melt, m.t_solid})
      if (t && least <= *t && *t <= greatest)
        return fmt::format(
            "{} changes phase at {} K within the scene's temperatures; LAMMPS runs conduction only", m.name,
            *t);
  return {};
}

std::string why_no_conduction(const Job& job) {
  const Scene& scene = job.scene;
  if (scene.mode == Mode::paper) return "the paper's forms belong to the particle solver; LAMMPS has none";
  if (!scene.events.empty()) return "heat is run in LAMMPS without events";
  if (!scene.inflows.empty()) return "heat is run in LAMMPS without inflow";
  for (const Body& b : scene.bodies) {
    if (!b.temperature) return fmt::format("{} has no temperature", b.name);
    const Material& m = scene.material(b.material);
    if (!m.conductivity || !m.heat_capacity)
      return fmt::format("{} has no conductivity or no heat capacity", m.name);
  }
  if (const std::string reason = moving(job); !reason.empty()) return reason;
  return changing_phase(scene);
}

double heat_per_volume(const Scene& scene, const Body& b) {
  const Material& m = scene.material(b.material);
  return m.density * heat_capacity_of(m, b.phase);
}
double diffusivity(const Scene& scene, const Body& b) {
  return conductivity_of(scene.material(b.material), b.phase) / heat_per_volume(scene, b);
}

Snapshot at_rest(const Job& job, const InitialState& state, double time, long step,
                 std::vector<double> temperature) {
  Snapshot s;
  s.time = time;
  s.step = step;
  s.position = state.position;
  s.velocity.resize(state.size());
  s.temperature = std::move(temperature);
  s.phase = state.phase;
  s.body = state.body;
  s.material = state.material;
  s.mass = state.mass;
  s.energy["thermal"] = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    s.id.push_back(static_cast<int>(i));
    s.total_mass += s.mass[i];
    s.energy["thermal"] += s.mass[i] *
                           heat_capacity_of(job.scene.materials.at(static_cast<std::size_t>(s.material[i])),
                                            static_cast<Phase>(s.phase[i])) *
                           s.temperature[i];
  }
  for (const JobBody& b : job.bodies) {
    if (b.index < 0) continue;
    BodyState body;
    body.position = b.properties.centre;
    body.mass = b.properties.mass;
    s.bodies.push_back(body);
  }
  return s;
}

Readback rest_readback(const Job& job, double time_step) {
  Readback back;
  back.gravity = job.scene.gravity;
  back.time_step = time_step;
  return back;
}

namespace {

/// Makes a face of the box one of fixed temperature. @return why the held body is no plate that covers one
std::string hold_face(const Body& plate, double spacing, CellBox& box) {
  const Vec3 &low = plate.shape.min, &high = plate.shape.max;
  if (plate.temperature->kind != TemperatureField::Kind::constant)
    return fmt::format("walkers need faces of one held temperature, and that of {} changes in place",
                       plate.name);
  const double tolerance = 1e-6 * spacing;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    const bool covers = low[a] <= box.min[a] + tolerance && high[a] >= box.max[a] - tolerance &&
                        low[b] <= box.min[b] + tolerance && high[b] >= box.max[b] - tolerance;
    const bool below = std::abs(high[k] - box.min[k]) < tolerance,
               above = std::abs(low[k] - box.max[k]) < tolerance;
    if (!covers || !(below || above)) continue;
    const int axis = static_cast<int>(k);
    if (box.periodic[k] || (box.held_axis >= 0 && box.held_axis != axis))
      return fmt::format("walkers know held faces across one direction only, and {} is another", plate.name);
    auto& face = below ? box.held_low : box.held_high;
    if (face) return fmt::format("{} is the second held body at one face", plate.name);
    box.held_axis = axis;
    face = plate.temperature->value;
    return {};
  }
  return fmt::format("walkers need held bodies that cover a whole face, and {} does not", plate.name);
}

}  // namespace

std::optional<CellBox> cell_box(const Scene& scene, std::string& why) {
  CellBox box;
  double filled = 0.0;
  bool first = true;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Shape& shape = scene.bodies[i].shape;
    if (!is_upright_box(shape)) {
      why = fmt::format("walkers need boxes, and {} is none", scene.bodies[i].name);
      return {};
    }
    if (scene.bodies[i].temperature_held) continue;
    const Vec3 e = shape.max - shape.min;
    filled += e.x * e.y * e.z;
    for (std::size_t k = 0; k < 3; ++k) {
      box.min[k] = first ? shape.min[k] : std::min(box.min[k], shape.min[k]);
      box.max[k] = first ? shape.max[k] : std::max(box.max[k], shape.max[k]);
    }
    first = false;
  }
  if (first) {
    why = "walkers need a body whose temperature is free";
    return {};
  }
  const Vec3 e = box.max - box.min;
  if (std::abs(filled / (e.x * e.y * e.z) - 1.0) > 1e-9)
    why = "walkers need one box, and the bodies do not tile one";
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = e[k] / scene.spacing;
    box.cells[k] = static_cast<int>(std::lround(n));
    if (box.cells[k] < 1 || std::abs(n - box.cells[k]) > 1e-6 * n)
      why = "walkers are counted in cells of one spacing, and the box is not a whole number of them";
    if (!scene.periodic[k] || !scene.min || !scene.max) continue;
    box.periodic[k] = std::abs((*scene.max)[k] - (*scene.min)[k] - e[k]) < 1e-9 * e[k];
  }
  for (const Body& b : scene.bodies)
    if (why.empty() && b.temperature_held) why = hold_face(b, scene.spacing, box);
  return why.empty() ? std::optional(box) : std::nullopt;
}

Range range_of(const TemperatureField& f, const std::vector<double>& values) {
  switch (f.kind) {
    case TemperatureField::Kind::constant:
      return {f.value, f.value};
    case TemperatureField::Kind::cosine:
      return {f.mean - std::abs(f.amplitude), f.mean + std::abs(f.amplitude)};
    case TemperatureField::Kind::step:
      return {std::min(f.behind, f.ahead), std::max(f.behind, f.ahead)};
    case TemperatureField::Kind::expression:
      break;
  }
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return {*least, *greatest};
}

}  // namespace tripoint::lammps
