// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/bodies.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "effects/rigid/applied_force.hpp"
#include "effects/rigid/fields.hpp"
#include "effects/rigid/rotation.hpp"
#include "sampling/sample.hpp"
#include "state/rows_loop.hpp"

namespace tripoint::rigid {
namespace {

/// State axes that the body may turn about: one that reaches through a periodic box turns about that axis
/// only.
Vec3 turning_axes(const State& state, const std::vector<std::size_t>& rows) {
  if (state.scene.is_planar()) return {0.0, 1.0, 0.0};
  Vec3 turns{1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!state.box.periodic[a] || rows.empty()) continue;
    double low = state.unwrapped(rows[0])[a], high = low;
    for (const std::size_t i : rows) {
      low = std::min(low, state.unwrapped(i)[a]);
      high = std::max(high, state.unwrapped(i)[a]);
    }
    if (high - low + state.scene.spacing < (1.0 - 1e-6) * state.box.width[a]) continue;
    for (std::size_t other = 0; other < 3; ++other) {
      if (other != a) turns[other] = 0.0;
    }
  }
  return turns;
}

}  // namespace

BodyMotion motion_of(const State& state, std::size_t b) {
  const Columns& t = state.bodies;
  return {t[field::body_mass][b], t[field::body_centre][b], t[field::body_velocity][b],
          t[field::body_angular_momentum][b], t[field::body_angular_velocity][b]};
}

bool is_free(const State& state, std::size_t body) {
  return is_alive(state, body) && is_rigid(state, body) &&
         state.bodies[field::body_motion][body] == static_cast<int>(Motion::free);
}

Quaternion principal_to_world(const State& state, std::size_t body) {
  return state.bodies[field::body_orientation][body] * state.bodies[field::body_axes][body];
}

double kinetic_energy(const State& state, std::size_t b) {
  const BodyMotion m = motion_of(state, b);
  return 0.5 * m.mass * dot(m.velocity, m.velocity) + 0.5 * dot(m.omega, m.L);
}

double potential_energy(const State& state, std::size_t b) {
  const double height =
      -state.bodies[field::body_mass][b] * dot(state.scene.gravity, state.bodies[field::body_centre][b]);
  return state.scene.forces.empty() ? height : height + potential_of_applied_forces(state, b);
}

void measure(State& state, std::size_t b) { measure(state, b, members(state, b)); }

void measure(State& state, std::size_t b, const std::vector<std::size_t>& rows) {
  Columns& t = state.bodies;
  t[field::body_alive][b] = !rows.empty();
  t[field::body_mass][b] = 0.0;
  if (rows.empty()) return;
  std::vector<Vec3> r;  // in the body frame, so that the principal axes come out in it
  std::vector<double> m;
  const Quaternion q = t[field::body_orientation][b];
  for (const std::size_t i : rows) {
    r.push_back(rotate_back(q, state.unwrapped(i)));
    m.push_back(state.particles[field::mass][i]);
  }
  const MassProperties properties = mass_properties(r, m);
  const Vec3 centre_before = t[field::body_centre][b];
  t[field::body_mass][b] = properties.mass;
  t[field::body_centre][b] = rotate(q, properties.centre);
  t[field::body_offset][b] += rotate_back(q, t[field::body_centre][b] - centre_before);
  t[field::body_inertia][b] = truncated(properties.principal_inertia, properties.mass, state.scene.spacing);
  t[field::body_axes][b] = properties.principal_axes;
  t[field::body_turns][b] = turning_axes(state, rows);
  const auto reference = triple(state.particles, field::reference);
  for (std::size_t n = 0; n < rows.size(); ++n) reference.set(rows[n], r[n] - properties.centre);
}

void update_spin(State& state, std::size_t b) {
  Columns& t = state.bodies;
  const Vec3 turns = t[field::body_turns][b], L = t[field::body_angular_momentum][b];
  const Quaternion q = principal_to_world(state, b);
  if (turns == Vec3{1.0, 1.0, 1.0}) {
    t[field::body_angular_velocity][b] = angular_velocity(q, t[field::body_inertia][b], L);
    return;
  }
  Vec3 omega;
  for (std::size_t a = 0; a < 3; ++a) {
    if (turns[a] == 0.0) continue;
    Vec3 axis;
    axis[a] = 1.0;
    const Vec3 e = rotate_back(q, axis), I = t[field::body_inertia][b];
    const double about = e.x * e.x * I.x + e.y * e.y * I.y + e.z * e.z * I.z;
    omega[a] = about > 0.0 ? L[a] / about : 0.0;
  }
  t[field::body_angular_velocity][b] = omega;
}

Vec3 spin_momentum(const State& state, std::size_t b) {
  const Quaternion q = principal_to_world(state, b);
  const Vec3 w = rotate_back(q, state.bodies[field::body_angular_velocity][b]),
             I = state.bodies[field::body_inertia][b];
  return rotate(q, {I.x * w.x, I.y * w.y, I.z * w.z});
}

void go_on_driven(State& state, std::size_t b, const BodyMotion& old) {
  Columns& t = state.bodies;
  t[field::body_velocity][b] = old.velocity_at(t[field::body_centre][b]);
  t[field::body_angular_velocity][b] = old.omega;
  t[field::body_angular_momentum][b] = spin_momentum(state, b);
}

void place_members(State& state) {
  Particles& p = state.particles;
  const auto x = positions(p);
  const auto reference = triple(std::as_const(p), field::reference);
  const auto body = p[field::body];
  const auto centre = state.bodies[field::body_centre];
  const auto orientation = state.bodies[field::body_orientation];
  const auto alive = state.bodies[field::body_alive];
  const RigidMembers is_member(state);
  // On the first call members of fixed bodies are placed too, which shifts them by a rounding error
  const std::size_t rows = state.placed ? p.moving() : p.size();
  state.placed = true;
  for_rows(rows, state.threads, [&](std::size_t i) {
    if (!is_member(i)) return;
    const auto b = static_cast<std::size_t>(body[i]);
    if (!alive[b]) return;
    const Vec3 r = centre[b] + rotate(orientation[b], reference.at(i));
    x.set(i, r);
  });
  if (!state.box.any()) return;
  const auto image = images(p);
  for (std::size_t i = 0; i < rows; ++i) {
    if (!is_member(i)) continue;
    Vec3 r = x.at(i);
    const Vec3 n = image.at(i);
    for (std::size_t a = 0; a < 3; ++a) {
      if (state.box.periodic[a]) r[a] -= n[a] * state.box.width[a];
    }
    x.set(i, r);
  }
}

void give_velocities(State& state) {
  Particles& p = state.particles;
  const auto v = velocities(p);
  const auto reference = triple(std::as_const(p), field::reference);
  const auto body = p[field::body];
  const auto velocity = state.bodies[field::body_velocity],
             omega = state.bodies[field::body_angular_velocity];
  const auto orientation = state.bodies[field::body_orientation];
  const RigidMembers is_member(state);
  for_rows(p.moving(), state.threads, [&](std::size_t i) {
    if (!is_member(i)) return;
    const auto b = static_cast<std::size_t>(body[i]);
    v.set(i, velocity[b] + cross(omega[b], rotate(orientation[b], reference.at(i))));
  });
}

}  // namespace tripoint::rigid
