// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/audit/audit_rates.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

/// One rigid body in all frames.
struct Spin {
  const JobBody& body;
  std::vector<Quaternion> orientation;
  std::vector<Vec3> angular_velocity;
};

/// How far an interval's turn is from what the angular velocities say, and how far it may be [rad].
struct TurnDifference {
  double found = 0.0, allowed = 0.0;
  [[nodiscard]] bool too_large() const { return found > allowed; }
};

/// Where frames are so coarse that a linear change of the angular velocity says less than this, a body that
/// nothing touches must turn as a free one [rad].
constexpr double freely_at_most = 0.25;

/// What a scheme of first or second order leaves of each of its steps: (w h)^2/12 of the turn.
double scheme_error(const Audited& run, double rate, double time) {
  const double turn_a_step = rate * run.step(time);
  return 0.15 * turn_a_step * turn_a_step * rate * time;
}

TurnDifference by_linear_change(const Audited& run, const Spin& spin, std::size_t n, const Quaternion& turn,
                                const Contact& contact) {
  const Rates w = rates_at(spin.angular_velocity, n);
  const double time = run.frames[n + 1]->time - run.frames[n]->time, rate = w.greatest();
  const double of_contact = contact.touches ? contact.hidden_speed / gyration_radius(spin.body) : 0.0;
  const double of_rates = allowed_difference(w, contact.touches) + norm(largest_lag(run, w, time)) +
                          rounding_rate(run, 1.0, 1e-6, time) + of_contact;
  const double most = contact.touches ? std::numeric_limits<double>::infinity() : freely_at_most;
  const double of_direction = norm(cross(w.first, w.last)) * time * time / 12.0;
  return {angle_between(linear_turn(w.first, w.last, time), turn),
          std::min(of_rates * time + of_direction, most) + scheme_error(run, rate, time)};
}

/// Beside the free motion from the interval's start: where the engine's own angular velocity at the end is
/// near that of the free motion, so must its turn be.
TurnDifference by_free_motion(const Audited& run, const Spin& spin, std::size_t n, const Quaternion& turn) {
  const Rates w = rates_at(spin.angular_velocity, n);
  const double time = run.frames[n + 1]->time - run.frames[n]->time, rate = w.greatest();
  const auto& p = spin.body.properties;
  const TorqueFree free(p.principal_inertia, spin.orientation[n] * p.principal_axes, w.first);
  const double apart = norm(free.angular_velocity(time) - w.last);
  const double most = 3.0 * rate * rate * time * run.step(time);
  const double rest = (1e-4 * rate + rounding_rate(run, 1.0, 1e-6, time)) * time;
  return {angle_between(free.rotation(time), turn),
          std::min(3.0 * apart * time, most) + scheme_error(run, rate, time) + rest};
}

bool turns_freely(const Audited& run, const Spin& spin, std::size_t n, const Quaternion& turn) {
  try {
    return !by_free_motion(run, spin, n, turn).too_large();
  } catch (const InputError&) {
    return true;  // about the middle axis, where there is no closed form and the frames say too little
  }
}

std::string turn_contradicts(const Audited& run, const Spin& spin, std::size_t n, PushOut& push_out) {
  push_out.enter(n);
  const Quaternion turn = spin.orientation[n + 1] * conjugate(spin.orientation[n]);
  if (!by_linear_change(run, spin, n, turn, {}).too_large()) return {};
  const auto row = static_cast<std::size_t>(&spin.body - run.job.bodies.data());
  const TurnDifference linear = by_linear_change(run, spin, n, turn, contact_of(run, row, n));
  if (!linear.too_large() || turns_freely(run, spin, n, turn) ||
      push_out.allows(n, (linear.found - linear.allowed) * gyration_radius(spin.body)))
    return {};
  return "contradicts itself: `" + spin.body.name + "` turns otherwise than its angular velocity says" +
         between(*run.frames[n], *run.frames[n + 1]) + ": by " + figure(linear.found) + " rad, where " +
         figure(linear.allowed) + " rad may be";
}

Spin spin_of(const Audited& run, const JobBody& b) {
  Spin spin{b, {}, {}};
  for (const auto* s : run.frames) {
    const BodyState& now = s->bodies[static_cast<std::size_t>(b.index)];
    spin.orientation.push_back(normalised(now.orientation));
    spin.angular_velocity.push_back(now.angular_velocity);
  }
  return spin;
}

}  // namespace

std::string turns_against_its_spin(const Audited& run) {
  if (!keeps_bodies(run.job)) return {};
  for (const auto& b : run.job.bodies) {
    if (!is_followed(run, b)) continue;
    const Spin spin = spin_of(run, b);
    PushOut push_out(run, static_cast<std::size_t>(&b - run.job.bodies.data()));
    for (std::size_t n = 0; n + 1 < run.frames.size(); ++n)
      if (auto why = turn_contradicts(run, spin, n, push_out); !why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
