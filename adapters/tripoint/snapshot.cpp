// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "adapters/tripoint/tripoint_engine.hpp"
#include "core/not_a_number.hpp"
#include "scene/effect_rule.hpp"
#include "scene/temperatures.hpp"
#include "solids/body_forces.hpp"
#include "solids/objects.hpp"
#include "solids/solid_particles.hpp"
#include "state/left_numbers.hpp"

namespace tripoint {
namespace {

std::vector<double> by_id(const Particles& p, const Field<double>& f) {
  if (!p.has(f.name)) return {};
  const auto column = p[f];
  std::vector<double> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = column[p.row(id)];
  return values;
}

std::vector<int> by_id(const Particles& p, const Field<int>& f) {
  const auto column = p[f];
  std::vector<int> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = column[p.row(id)];
  return values;
}

/// Values by id become values by the number of the trajectory's row.
template <class T>
void spread(std::vector<T>& values, const std::vector<int>& number, std::size_t rows, const T& none) {
  if (values.empty()) return;
  std::vector<T> by_number(rows, none);
  for (std::size_t id = 0; id < values.size(); ++id)
    by_number[static_cast<std::size_t>(number[id])] = values[id];
  values = std::move(by_number);
}

/// Particles that have left keep their rows, without values.
void show_left(const State& state, Snapshot& s) {
  const std::vector<int> number = by_id(state.particles, field::number);
  const StepNumbers& numbers = state.step_numbers;
  const auto rows = static_cast<std::size_t>(numbers[left_numbers::ever]);
  constexpr Vec3 nowhere{not_a_number, not_a_number, not_a_number};
  s.id = number;
  spread(s.id, number, rows, -1);
  spread(s.position, number, rows, nowhere);
  spread(s.velocity, number, rows, nowhere);
  for (auto* column : {&s.temperature, &s.density, &s.pressure, &s.liquid_fraction, &s.mass})
    spread(*column, number, rows, not_a_number);
  for (auto* column : {&s.phase, &s.material}) spread(*column, number, rows, 0);
  spread(s.body, number, rows, -1);
  s.counts["left"] = numbers[left_numbers::left];
  s.counts["mass_left"] = numbers[left_numbers::mass];
}

BodyState body_state(const State& state, std::size_t b) {
  const Columns& bodies = state.bodies;
  if (!bodies[field::body_alive][b]) {
    constexpr Vec3 nowhere{not_a_number, not_a_number, not_a_number};
    return {nowhere,      nowhere, nowhere, {not_a_number, not_a_number, not_a_number, not_a_number},
            not_a_number, nowhere, nowhere};
  }
  BodyState s;
  if (!is_rigid(state, b)) {
    const WholeMotion whole = whole_motion(state, b);
    s.position = whole.centre;
    s.velocity = whole.velocity;
    s.angular_velocity = whole.spin;
    s.mass = whole.mass;
    s.orientation = solid::orientation_of(state, b);
    return s;
  }
  s.position = bodies[field::body_centre][b];
  s.velocity = bodies[field::body_velocity][b];
  s.angular_velocity = bodies[field::body_angular_velocity][b];
  s.orientation = bodies[field::body_orientation][b];
  s.mass = bodies[field::body_mass][b];
  return s;
}

}  // namespace

Snapshot snapshot_of(Simulation& simulation) {
  simulation.complete_bodies();
  const State& state = simulation.state();
  const Particles& p = state.particles;
  Snapshot s;
  s.time = state.time;
  s.step = simulation.steps();
  for (std::size_t id = 0; id < p.size(); ++id) {
    s.position.push_back(state.unwrapped(p.row(id)));
    s.velocity.push_back(p.velocity(p.row(id)));
    s.id.push_back(static_cast<int>(id));
  }
  s.temperature = by_id(p, field::temperature);
  // Heat keeps no column then
  if (const auto equal = equal_temperature(state.scene)) s.temperature.assign(p.size(), *equal);
  s.density = by_id(p, field::density);
  s.pressure = by_id(p, field::pressure);
  s.liquid_fraction = by_id(p, field::liquid_fraction);
  s.phase = by_id(p, field::phase);
  s.body = by_id(p, field::body);
  s.material = by_id(p, field::material);
  s.mass = by_id(p, field::mass);
  const std::vector<BodyForces> forces = forces_on_bodies(state);
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    s.bodies.push_back(body_state(state, b));
    if (forces.empty() || !state.bodies[field::body_alive][b]) continue;
    s.bodies.back().force = forces[b].force();
    s.bodies.back().torque = forces[b].torque();
  }
  const Ledger sums = simulation.ledger();
  s.total_mass = sums.mass;
  s.momentum = sums.momentum;
  s.angular_momentum = sums.angular_momentum;
  s.energy = sums.energy;
  if (state.bodies.has(field::body_heat.name))
    for (std::size_t b = 0; b < state.bodies.size(); ++b)
      if (state.bodies[field::body_source][b] >= 0)
        s.heat_given[state.body_names[b]] = state.bodies[field::body_heat][b];
  if (calls_for(state.scene, &EffectRule::has_bonds))
    s.counts["objects"] = static_cast<double>(count_objects(state));
  if (p.has(field::number)) show_left(state, s);
  if (state.scene.recovers) s.counts["recoveries"] = static_cast<double>(simulation.recovery().count());
  return s;
}

}  // namespace tripoint
