// SPDX-License-Identifier: BSD-3-Clause
#include "state/body_table.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"

namespace tripoint {

std::vector<FieldInfo> body_table_fields() {
  return {field::body_phase,
          field::body_mass,
          field::body_centre,
          field::body_velocity,
          field::body_acceleration,
          field::body_angular_acceleration,
          field::body_angular_momentum,
          field::body_angular_velocity,
          field::body_inertia,
          field::body_orientation,
          field::body_axes,
          field::body_turns,
          field::body_start_centre,
          field::body_offset,
          field::body_start_velocity,
          field::body_start_spin,
          field::body_motion,
          field::body_alive,
          field::body_source,
          field::body_grip,
          field::body_grip_centre,
          field::body_grip_orientation};
}

std::vector<Bounded> body_table_bounds() {
  const auto three = [](const State&) -> std::size_t { return 3; };  // phases; motions
  const auto yes_or_no = [](const State&) -> std::size_t { return 2; };
  return {{field::body_phase, 0, three},
          {field::body_motion, 0, three},
          {field::body_alive, 0, yes_or_no},
          {field::body_grip, 0, [](const State& w) { return w.scene.events.size() + 1; }},
          {field::body_source, -1, [](const State& w) { return w.scene.bodies.size(); }}};
}

bool can_have_bodies(const Scene& scene) {
  const bool solid =
      std::ranges::any_of(scene.bodies, [](const Body& b) { return b.phase != Phase::liquid; });
  return solid || calls_for(scene, &EffectRule::makes_bodies);
}

bool can_have_deformable_bodies(const Scene& scene) { return calls_for(scene, &EffectRule::deforms_bodies); }

std::vector<std::size_t> members(const State& state, std::size_t body) {
  std::vector<std::size_t> rows;
  const auto of = state.particles[field::body];
  for (std::size_t id = 0; id < of.size(); ++id) {
    const std::size_t i = state.particles.row(id);
    if (of[i] == static_cast<int>(body)) rows.push_back(i);
  }
  return rows;
}

std::vector<std::vector<std::size_t>> members_of_all(const State& state) {
  std::vector<std::vector<std::size_t>> rows(state.bodies.size());
  const auto of = state.particles[field::body];
  for (std::size_t id = 0; id < of.size(); ++id) {
    const std::size_t i = state.particles.row(id);
    if (of[i] >= 0) rows[static_cast<std::size_t>(of[i])].push_back(i);
  }
  return rows;
}

std::size_t add_body(State& state, std::string_view name, Phase phase) {
  Columns& t = state.bodies;
  t.append_row();
  const std::size_t b = t.size() - 1;
  t[field::body_phase][b] = static_cast<int>(phase);
  t[field::body_orientation][b] = {};
  t[field::body_axes][b] = {};
  t[field::body_turns][b] = {1.0, 1.0, 1.0};
  t[field::body_alive][b] = 1;
  t[field::body_source][b] = -1;
  state.body_names.emplace_back(name);
  return b;
}

void add_scene_bodies(State& state) {
  for (std::size_t n = 0; n < state.scene.bodies.size(); ++n) {
    const Body& body = state.scene.bodies[n];
    if (body.phase == Phase::liquid) continue;
    const bool deformable = body.phase == Phase::elastic && body.motion == Motion::free;
    const std::size_t b = add_body(state, body.name, deformable ? Phase::elastic : Phase::rigid);
    state.bodies[field::body_source][b] = static_cast<int>(n);
    state.bodies[field::body_motion][b] = static_cast<int>(body.motion);
  }
}

std::size_t body_row(const State& state, std::string_view name) {
  const auto place = std::ranges::find(state.body_names, name);
  if (place == state.body_names.end())
    throw InputError("an event names the body " + std::string(name) + ", and no solid body has that name");
  const auto row = static_cast<std::size_t>(place - state.body_names.begin());
  if (!is_alive(state, row))
    throw InputError("an event names the body " + std::string(name) + ", which has been absorbed before");
  return row;
}

WholeMotion whole_motion(std::span<const Vec3> place, std::span<const Vec3> velocity,
                         const std::vector<double>& mass) {
  WholeMotion whole;
  if (place.empty()) return whole;
  Vec3 P, moment;
  for (std::size_t k = 0; k < place.size(); ++k) {
    const Vec3 p = mass[k] * velocity[k];
    P += p;
    moment += cross(place[k], p);
  }
  const MassProperties m = mass_properties({place.begin(), place.end()}, mass);
  whole.mass = m.mass;
  whole.centre = m.centre;
  whole.velocity = P / m.mass;
  const Vec3 L = rotate_back(m.principal_axes, moment - cross(m.centre, P));
  Vec3 w;
  for (std::size_t a = 0; a < 3; ++a)
    w[a] = m.principal_inertia[a] > 1e-12 * m.principal_inertia.z ? L[a] / m.principal_inertia[a] : 0.0;
  whole.spin = rotate(m.principal_axes, w);
  return whole;
}

WholeMotion whole_motion(const State& state, std::size_t body) {
  std::vector<Vec3> place, velocity;
  std::vector<double> mass;
  for (const std::size_t i : members(state, body)) {
    place.push_back(state.unwrapped(i));
    velocity.push_back(state.particles.velocity(i));
    mass.push_back(state.particles[field::mass][i]);
  }
  return whole_motion(place, velocity, mass);
}

}  // namespace tripoint
