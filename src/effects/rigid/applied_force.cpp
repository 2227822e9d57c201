// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/applied_force.hpp"

#include <algorithm>

#include "effects/rigid/bodies.hpp"
#include "effects/rigid/fields.hpp"

namespace tripoint::rigid {
namespace {

/// Of the forces that have a potential, and of those that have none.
struct Applied {
  Vec3 force, torque;            ///< [N], [N m] about the centre of mass
  Vec3 paid_force, paid_torque;  ///< without a potential, means over the time that is asked for
  double potential = 0.0;        ///< [J]
};

/// A time of the step [s].
struct Lapse {
  double from, to;
};

/// The half step of a kick: the first begins at the present time, the second ends there.
Lapse half_step(const State& state, double dt) {
  return state.time < state.next_time ? Lapse{state.time, state.time + dt}
                                      : Lapse{state.time - dt, state.time};
}

/// Share of a time in which a force acts.
double share_of(const AppliedForce& f, const Lapse& lapse) {
  if (!f.is_timed()) return 1.0;
  const double acts = std::min(lapse.to, f.stop.value_or(lapse.to)) - std::max(lapse.from, f.start);
  return std::max(0.0, acts) / (lapse.to - lapse.from);
}

Applied applied_to(const State& state, std::size_t b, const Lapse& lapse) {
  Applied sum;
  const Columns& t = state.bodies;
  const int source = t[field::body_source][b];
  if (source < 0) return sum;
  const Vec3 centre = t[field::body_centre][b];
  for (const AppliedForce& f : state.scene.forces) {
    if (f.body != state.scene.bodies[static_cast<std::size_t>(source)].name) continue;
    const Vec3 arm =
        f.point ? rotate(t[field::body_orientation][b], *f.point - t[field::body_start_centre][b]) : Vec3{};
    if (f.has_no_potential()) {
      const double share = share_of(f, lapse);
      sum.paid_force += share * f.value;
      sum.paid_torque += share * (cross(arm, f.value) + f.torque);
      continue;
    }
    sum.force += f.value;
    sum.torque += cross(arm, f.value);
    sum.potential -= dot(f.value, centre + arm);
  }
  return sum;
}

/// A time in which every force that ever acts is seen whole.
Lapse whole_run(const State& state) { return {0.0, state.scene.end_time}; }

}  // namespace

bool has_forces_without_potential(const Scene& scene) {
  return std::ranges::any_of(scene.forces, [](const AppliedForce& f) { return f.has_no_potential(); });
}

void push_by_applied_forces(State& state, std::size_t b, double dt) {
  const Applied applied = applied_to(state, b, half_step(state, dt));
  Columns& t = state.bodies;
  Vec3& v = t[field::body_velocity][b];
  const Vec3 v_before = v, omega_before = t[field::body_angular_velocity][b];
  v += (dt / t[field::body_mass][b]) * (applied.force + applied.paid_force);
  t[field::body_angular_momentum][b] += dt * (applied.torque + applied.paid_torque);
  update_spin(state, b);
  t[field::body_acceleration][b] += (1.0 / dt) * (v - v_before);
  t[field::body_angular_acceleration][b] += (1.0 / dt) * (t[field::body_angular_velocity][b] - omega_before);
  if (!state.reports(b)) return;
  const Vec3 mean = 0.5 * (v_before + v), spin = 0.5 * (omega_before + t[field::body_angular_velocity][b]);
  state.accumulated[account::gravity_work] += dt * (dot(applied.force, mean) + dot(applied.torque, spin));
  if (state.accumulated.has(account::applied_work))
    state.accumulated[account::applied_work] +=
        dt * (dot(applied.paid_force, mean) + dot(applied.paid_torque, spin));
}

double potential_of_applied_forces(const State& state, std::size_t b) {
  return applied_to(state, b, whole_run(state)).potential;
}

double applied_acceleration(const State& state, std::size_t b) {
  double sum = norm(applied_to(state, b, whole_run(state)).force);
  const int source = state.bodies[field::body_source][b];
  for (const AppliedForce& f : state.scene.forces)
    if (f.has_no_potential() && source >= 0 &&
        f.body == state.scene.bodies[static_cast<std::size_t>(source)].name)
      sum += norm(f.value);
  return sum / state.bodies[field::body_mass][b];
}

}  // namespace tripoint::rigid
