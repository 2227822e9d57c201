// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/applied_force.hpp"

#include "effects/rigid/bodies.hpp"
#include "effects/rigid/fields.hpp"

namespace tripoint::rigid {
namespace {

struct Applied {
  Vec3 force, torque;      ///< [N], [N m] about the centre of mass
  double potential = 0.0;  ///< [J]
};

Applied applied_to(const State& state, std::size_t b) {
  Applied sum;
  const Columns& t = state.bodies;
  const int source = t[field::body_source][b];
  if (source < 0) return sum;
  const Vec3 centre = t[field::body_centre][b];
  for (const AppliedForce& f : state.scene.forces) {
    if (f.body != state.scene.bodies[static_cast<std::size_t>(source)].name) continue;
    const Vec3 arm =
        f.point ? rotate(t[field::body_orientation][b], *f.point - t[field::body_start_centre][b]) : Vec3{};
    sum.force += f.value;
    sum.torque += cross(arm, f.value);
    sum.potential -= dot(f.value, centre + arm);
  }
  return sum;
}

}  // namespace

void push_by_applied_forces(State& state, std::size_t b, double dt) {
  const Applied applied = applied_to(state, b);
  Columns& t = state.bodies;
  Vec3& v = t[field::body_velocity][b];
  const Vec3 v_before = v, omega_before = t[field::body_angular_velocity][b];
  v += (dt / t[field::body_mass][b]) * applied.force;
  t[field::body_angular_momentum][b] += dt * applied.torque;
  update_spin(state, b);
  t[field::body_acceleration][b] += (1.0 / dt) * (v - v_before);
  t[field::body_angular_acceleration][b] += (1.0 / dt) * (t[field::body_angular_velocity][b] - omega_before);
  if (!state.tells_of(b)) return;
  const Vec3 mean = 0.5 * (v_before + v), spin = 0.5 * (omega_before + t[field::body_angular_velocity][b]);
  state.booked[account::gravity_work] += dt * (dot(applied.force, mean) + dot(applied.torque, spin));
}

double potential_of_applied_forces(const State& state, std::size_t b) {
  return applied_to(state, b).potential;
}

double applied_acceleration(const State& state, std::size_t b) {
  return norm(applied_to(state, b).force) / state.bodies[field::body_mass][b];
}

}  // namespace tripoint::rigid
