// SPDX-License-Identifier: BSD-3-Clause
#include "validation/audit/audit_rates.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

constexpr Vec3 no_value{not_a_number, not_a_number, not_a_number};
/// A smooth rate asks for 1/12 of its second difference, a jump within the interval for 1/2 of it. Contact
/// jumps several times.
constexpr double rough_share = 0.75, rough_share_in_contact = 4.0;
constexpr double five_digits = 1e-5;

/// Largest change of a body's velocity and, at its radius of gyration, of its spin [m/s].
double change_of_speed(const Audited& run, const JobBody& b, std::size_t interval) {
  const auto row = static_cast<std::size_t>(b.index);
  const BodyState &from = run.frames[interval]->bodies[row], &to = run.frames[interval + 1]->bodies[row];
  return std::max(norm(to.velocity - from.velocity),
                  gyration_radius(b) * norm(to.angular_velocity - from.angular_velocity));
}

/// Way of a body in a step of the hit within an interval; 0 where it is not hit [m].
double depth_of_hit(const Audited& run, std::size_t body, std::size_t interval) {
  const JobBody& b = run.job.bodies[body];
  const double time = run.frames[interval + 1]->time - run.frames[interval]->time, step = run.step(time);
  if (!contact_of(run, body, interval).touches || !is_hit(run, b, interval)) return 0.0;
  return (step > 0.0 ? step : time) * change_of_speed(run, b, interval);
}

}  // namespace

double Rates::greatest() const { return std::max(norm(first), norm(last)); }

double Rates::roughness() const {
  const double bends[] = {norm(before - 2.0 * first + last), norm(first - 2.0 * last + after)};
  double most = std::isfinite(bends[0]) || std::isfinite(bends[1]) ? 0.0 : norm(last - first);
  for (const double bend : bends)
    if (std::isfinite(bend)) most = std::max(most, bend);
  return most;
}

Rates rates_at(const std::vector<Vec3>& in_time, std::size_t interval) {
  return {interval > 0 ? in_time[interval - 1] : no_value, in_time[interval], in_time[interval + 1],
          interval + 2 < in_time.size() ? in_time[interval + 2] : no_value};
}

bool is_interrupted(const Job& job, const Snapshot& a, const Snapshot& b) {
  const auto takes_hold = [&](const Event& e) {
    const bool is_over = e.kind != Event::Kind::grip && e.until.value_or(e.time) < a.time;
    return e.kind != Event::Kind::heat && e.time <= b.time && !is_over;
  };
  return std::any_of(job.scene.events.begin(), job.scene.events.end(), takes_hold);
}

bool is_followed(const Audited& run, const JobBody& b) {
  return b.index >= 0 && b.phase == Phase::rigid && b.motion == Motion::free &&
         std::all_of(run.frames.begin(), run.frames.end(), [&](const Snapshot* s) {
           const auto row = static_cast<std::size_t>(b.index);
           return row < s->bodies.size() && is_there(s->bodies[row]);
         });
}

bool is_hit(const Audited& run, const JobBody& b, std::size_t interval) {
  const double time = run.frames[interval + 1]->time - run.frames[interval]->time;
  return change_of_speed(run, b, interval) > weight_and_friction * norm(run.job.scene.gravity) * time;
}

double depth_at_start(const Audited& run, std::size_t body) {
  constexpr double fineness = 0.01;
  if (!run.overlaps) run.overlaps = shared_spaces(run.job.scene, run.initial, fineness);
  double most = 0.0;
  for (const SharedSpace& s : *run.overlaps)
    if (s.a == body || s.b == body) most = std::max(most, s.thickness);
  return most;
}

double depth_of_hits(const Audited& run, std::size_t body) {
  double all = 0.0;
  for (std::size_t n = 0; n + 1 < run.frames.size(); ++n) all += depth_of_hit(run, body, n);
  return all;
}

void PushOut::enter(std::size_t interval) { depth_ = std::max(depth_, depth_of_hit(run_, body_, interval)); }

bool PushOut::allows(std::size_t interval, double excess) {
  if (!contact_of(run_, body_, interval).touches) return false;
  if (excess > depth_ && !knows_start_) {
    knows_start_ = true;
    depth_ += depth_at_start(run_, body_);
  }
  depth_ -= excess;
  return depth_ >= 0.0;
}

double gyration_radius(const JobBody& b) {
  return std::sqrt(std::max(b.properties.principal_inertia.x, 0.0) / b.properties.mass);
}

Quaternion linear_turn(const Vec3& first, const Vec3& last, double time) {
  constexpr int parts = 64;
  Quaternion turn;
  for (int k = 0; k < parts; ++k) {
    const double s = (k + 0.5) / parts;
    turn = from_rotation_vector((time / parts) * ((1.0 - s) * first + s * last)) * turn;
  }
  return turn;
}

double allowed_difference(const Rates& rates, bool touches) {
  return (touches ? rough_share_in_contact : rough_share) * rates.roughness() +
         five_digits * rates.greatest();
}

Vec3 largest_lag(const Audited& run, const Rates& rates, double interval) {
  return (0.51 * run.step(interval) / interval) * rates.change();
}

double rounding_rate(const Audited& run, double size, double output, double interval) {
  const double step = run.step(interval), steps = 2.0 + (step > 0.0 ? interval / step : 1.0);
  // Engines of single precision have four substeps a step
  const double last_digit = run.is_single() ? 4.8e-7 : 2.3e-16;
  return (steps * last_digit * size + output) / interval;
}

}  // namespace tripoint
