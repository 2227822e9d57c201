// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/springs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/rigid/applied_force.hpp"
#include "effects/rigid/bodies.hpp"

namespace tripoint::rigid {
namespace {

constexpr double share_of_swing = 0.1;    ///< of 1/omega that a step takes [1]: 4e-4 off in frequency
constexpr double share_of_damping = 0.2;  ///< of m/c that a step takes [1]

/// One end: a point of a body, or of the world.
struct End {
  bool free = false;
  std::size_t body = 0;
  Vec3 place, velocity, arm;  ///< [m], [m/s], [m] from the centre of mass
};

End end_of(const State& state, const std::string& name, const Vec3& point) {
  End e;
  e.place = point;
  if (name == "world") return e;
  e.body = body_row(state, name);
  e.free = is_free(state, e.body);
  const Columns& t = state.bodies;
  e.arm = rotate(t[field::body_orientation][e.body], point - t[field::body_start_centre][e.body]);
  e.place = t[field::body_centre][e.body] + e.arm;
  if (t[field::body_motion][e.body] != static_cast<int>(Motion::fixed))
    e.velocity = motion_of(state, e.body).velocity_at(e.place);
  return e;
}

/// The line of a spring, from the other to the body.
struct Line {
  End one, other;
  Vec3 direction;
  double stretch;   ///< [m]
  double speed;     ///< at which the ends part [m/s]
  double mobility;  ///< change of it by a unit impulse [1/kg]
};

/// Velocity that a unit impulse along n gives to the point, along n [1/kg].
double mobility_of(const State& state, const End& e, const Vec3& n) {
  if (!e.free) return 0.0;
  const Quaternion q = principal_to_world(state, e.body);
  const Vec3 I = state.bodies[field::body_inertia][e.body], turn = rotate_back(q, cross(e.arm, n));
  double sum = 1.0 / state.bodies[field::body_mass][e.body];
  for (std::size_t a = 0; a < 3; ++a)
    if (I[a] > 0.0) sum += turn[a] * turn[a] / I[a];
  return sum;
}

Line line_of(const State& state, const Spring& s) {
  Line l{end_of(state, s.body, s.point), end_of(state, s.other, s.other_point), {}, 0.0, 0.0, 0.0};
  const Vec3 d = l.one.place - l.other.place;
  const double length = norm(d);
  l.direction = length > 0.0 ? d / length : Vec3{};
  l.stretch = length - s.length.value_or(norm(s.point - s.other_point));
  l.speed = dot(l.direction, l.one.velocity - l.other.velocity);
  l.mobility = mobility_of(state, l.one, l.direction) + mobility_of(state, l.other, l.direction);
  return l;
}

/// An impulse at an end. @return its work [J]
double push(State& state, const End& e, const Vec3& impulse, double dt) {
  if (!e.free) return dot(impulse, e.velocity);
  Columns& t = state.bodies;
  Vec3& v = t[field::body_velocity][e.body];
  const Vec3 v_before = v, omega_before = t[field::body_angular_velocity][e.body];
  v += impulse / t[field::body_mass][e.body];
  t[field::body_angular_momentum][e.body] += cross(e.arm, impulse);
  update_spin(state, e.body);
  const Vec3 omega = t[field::body_angular_velocity][e.body];
  t[field::body_acceleration][e.body] += (1.0 / dt) * (v - v_before);
  t[field::body_angular_acceleration][e.body] += (1.0 / dt) * (omega - omega_before);
  return dot(impulse, 0.5 * (v_before + v)) + dot(cross(e.arm, impulse), 0.5 * (omega_before + omega));
}

/// @param after with the velocity after it, not before
void pull(State& state, const Spring& s, double dt, bool after) {
  const Line l = line_of(state, s);
  const double held = -s.stiffness * l.stretch;
  const double speed =
      after ? (l.speed + dt * held * l.mobility) / (1.0 + dt * s.damping * l.mobility) : l.speed;
  const double force = held - s.damping * speed;
  if (force == 0.0) return;
  const Vec3 impulse = (dt * force) * l.direction;
  const double on_one = push(state, l.one, impulse, dt), on_other = push(state, l.other, -impulse, dt);
  const double work = on_one + on_other, stored = held / force * work;
  state.accumulated[account::gravity_work] += stored;
  if (s.damping > 0.0) state.accumulated[account::applied_work] += work - stored;
  if (!l.other.free) state.accumulated[account::walls] += on_other;
}

}  // namespace

void pull_by_springs(State& state, double dt) {
  const auto& springs = state.scene.springs;
  const bool first = state.time < state.next_time;
  for (std::size_t n = 0; n < springs.size(); ++n)
    pull(state, springs[first ? n : springs.size() - 1 - n], dt, !first);
}

double spring_energy(const State& state) {
  double sum = 0.0;
  for (const Spring& s : state.scene.springs) {
    const double stretch = line_of(state, s).stretch;
    sum += 0.5 * s.stiffness * stretch * stretch;
  }
  return sum;
}

double spring_step(const State& state) {
  double least = std::numeric_limits<double>::infinity();
  for (const Spring& s : state.scene.springs) {
    const double mobility = line_of(state, s).mobility;
    if (s.stiffness > 0.0) least = std::min(least, share_of_swing / std::sqrt(s.stiffness * mobility));
    if (s.damping > 0.0) least = std::min(least, share_of_damping / (s.damping * mobility));
  }
  return least;
}

}  // namespace tripoint::rigid
