// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose motion the job gives: what is fixed stays, and what is led is where it is led.
#include <algorithm>
#include <cmath>

#include "scene/motion.hpp"
#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

/// Room for the digits of an output, of the spacing, and in radians.
constexpr double digits = 1e-3;

/// What a body is given at a time, and how far from it a right engine may show it.
struct Given {
  PrescribedState state;
  double way = 0.0, turn = 0.0;  // [m], [rad]
};

/// A keyframe within a step of a time gives another velocity before than after it.
bool bends(const JobBody& b, double time, double step) {
  return std::ranges::any_of(b.keyframes,
                             [&](const Keyframe& k) { return std::abs(k.time - time) <= 1.5 * step; });
}

/// An engine of first order may be a step ahead of it or behind.
Given given_at(const Audited& run, const JobBody& b, const Snapshot& s) {
  const bool led = b.motion == Motion::prescribed;
  const auto keys = led ? b.keyframes : std::vector<Keyframe>{};
  const Vec3 velocity = led ? b.velocity : Vec3{}, spin = led ? b.angular_velocity : Vec3{};
  const double step = run.step(run.job.scene.end_time);
  Given given{prescribed_state(keys, b.properties.centre, velocity, spin, s.time), 0.0, 0.0};
  const double size = std::max(norm(given.state.position), run.job.scene.spacing);
  const double rounding = rounding_rate(run, 1.0, 0.0, std::max(s.time, step));  // [1/s]
  given.way = digits * run.job.scene.spacing + 1.1 * step * norm(given.state.velocity) +
              rounding * std::max(s.time, step) * size;
  given.turn = digits + 1.1 * step * norm(given.state.angular_velocity) + rounding * std::max(s.time, step);
  return given;
}

std::string apart_from(const Audited& run, const JobBody& b, const Snapshot& s, const BodyState& now) {
  const Given given = given_at(run, b, s);
  const std::string what = b.motion == Motion::fixed ? "is fixed" : "is led";
  const double way = norm(displacement(run.job.scene, now.position, given.state.position)),
               turn = angle_between(now.orientation, given.state.rotation);
  if (way > given.way)
    return "`" + b.name + "` " + what + ", and lies " + figure(way) + " m from its place" + at_time(s);
  if (turn > given.turn)
    return "`" + b.name + "` " + what + ", and is turned by " + figure(turn) + " rad" + at_time(s);
  if (bends(b, s.time, run.step(run.job.scene.end_time))) return {};
  const double time = run.job.scene.end_time, faster = norm(now.velocity - given.state.velocity),
               spins = norm(now.angular_velocity - given.state.angular_velocity);
  if (faster * time > digits * (run.job.scene.spacing + time * norm(given.state.velocity)))
    return "`" + b.name + "` " + what + ", and has a velocity that is off by " + figure(faster) + " m/s" +
           at_time(s);
  if (spins * time > digits * (1.0 + time * norm(given.state.angular_velocity)))
    return "`" + b.name + "` " + what + ", and has an angular velocity that is off by " + figure(spins) +
           " rad/s" + at_time(s);
  return {};
}

}  // namespace

std::string moves_otherwise_than_given(const Audited& run) {
  if (!keeps_bodies(run.job)) return {};
  for (const auto& b : run.job.bodies) {
    if (b.motion == Motion::free || b.phase != Phase::rigid || b.index < 0) continue;
    for (const auto* s : run.frames) {
      const auto row = static_cast<std::size_t>(b.index);
      if (row >= s->bodies.size() || !is_there(s->bodies[row]) || !finite(s->bodies[row].angular_velocity))
        continue;
      if (auto why = apart_from(run, b, *s, s->bodies[row]); !why.empty()) return why;
    }
  }
  return {};
}

}  // namespace tripoint
