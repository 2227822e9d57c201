// SPDX-License-Identifier: BSD-3-Clause
// A lag or a factor that all frames share: ways and turns of all smooth intervals are fitted by both, where
// one interval alone says too little.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

/// A number with its standard error; without bound where the frames do not say it.
struct Fitted {
  double value = 0.0, error = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool is_beyond(double most) const { return std::abs(value) > most + 5.0 * error; }
};

/// Least squares of  off = share * rate - lag * slope  over vectors.
class Fit {
 public:
  void take(const Vec3& off, const Vec3& slope, const Vec3& rate) {
    ss_ += dot(slope, slope);
    sr_ += dot(slope, rate);
    rr_ += dot(rate, rate);
    so_ += dot(slope, off);
    ro_ += dot(rate, off);
    oo_ += dot(off, off);
    ++count_;
  }
  [[nodiscard]] Fitted lag() const { return fitted((ro_ * sr_ - so_ * rr_) / determinant(), rr_); }
  [[nodiscard]] Fitted share() const { return fitted((ro_ * ss_ - so_ * sr_) / determinant(), ss_); }
  [[nodiscard]] double mean_square_rate() const { return count_ > 0 ? rr_ / count_ : 0.0; }
  /// What a lag of this time makes of the rate, as a part of it.
  [[nodiscard]] double effect(double time) const { return rr_ > 0.0 ? time * std::sqrt(ss_ / rr_) : 0.0; }

 private:
  [[nodiscard]] double determinant() const { return ss_ * rr_ - sr_ * sr_; }
  [[nodiscard]] Fitted fitted(double value, double diagonal) const {
    constexpr int enough = 6;
    if (count_ < enough || !(determinant() > 1e-6 * ss_ * rr_)) return {};
    const double slope = (so_ * rr_ - ro_ * sr_) / determinant(),
                 rate = (ro_ * ss_ - so_ * sr_) / determinant();
    const double left = std::max(0.0, oo_ - slope * so_ - rate * ro_) / (3.0 * count_ - 2.0);
    return {value, std::sqrt(left * diagonal / determinant())};
  }
  double ss_ = 0.0, sr_ = 0.0, rr_ = 0.0, so_ = 0.0, ro_ = 0.0, oo_ = 0.0;
  int count_ = 0;
};

/// A rate of one rigid body in all frames, and the length that makes a speed of it: 1, or the radius at which
/// contact turns the body.
struct History {
  const Audited& run;
  const JobBody& body;
  Vec3 BodyState::*rate;
  double length;

  [[nodiscard]] const BodyState& state(std::size_t n) const {
    return run.frames[n]->bodies[static_cast<std::size_t>(body.index)];
  }
  [[nodiscard]] const Vec3& at(std::size_t n) const { return state(n).*rate; }
  [[nodiscard]] double time(std::size_t n) const { return run.frames[n + 1]->time - run.frames[n]->time; }
  [[nodiscard]] double step(std::size_t n) const {
    const double known = run.step(time(n));
    return known > 0.0 ? known : time(n);
  }
  [[nodiscard]] bool turns() const { return rate == &BodyState::angular_velocity; }
};

/// Rate of which a hundredth is more than roundings leave.
double least_rate(const History& h, std::size_t n) {
  const double size = h.turns() ? 1.0 : norm(h.state(n).position);
  const double output = h.turns() ? 1e-6 : 1e-6 * h.run.job.scene.spacing;
  return 100.0 * rounding_rate(h.run, size, output, h.time(n));
}

bool touches(const History& h, std::size_t n) {
  return contact_of(h.run, static_cast<std::size_t>(&h.body - h.run.job.bodies.data()), n).touches;
}

/// Whether no hit changes the rates in an interval. In contact the body is faster than bodies at rest
/// tremble, too.
bool is_smooth(const History& h, std::size_t n) {
  if (is_interrupted(h.run.job, *h.run.frames[n], *h.run.frames[n + 1])) return false;
  const double rate = std::min(norm(h.at(n)), norm(h.at(n + 1)));
  if (rate < least_rate(h, n)) return false;
  if (!touches(h, n)) return true;
  return !is_hit(h.run, h.body, n) && rate * h.length > norm(h.run.job.scene.gravity) * h.time(n);
}

/// Mean of a rate over an interval by the four frames about it, less that by two.
Vec3 bend(const History& h, std::size_t n) {
  return (1.0 / 24.0) * (h.at(n) + h.at(n + 1) - h.at(n - 1) - h.at(n + 2));
}

/// A change of rate that says nothing of a lag, nor of a factor.
double known_rate(const History& h, std::size_t n) { return 1e-4 * norm(h.at(n)); }

/// Whether a rate changes evenly about an interval. A force that starts, ends or trembles within one says
/// nothing of a lag: the way depends on when.
bool is_even(const History& h, std::size_t n) {
  const Vec3 change = h.at(n + 1) - h.at(n);
  const double uneven =
      std::max(norm(change - (h.at(n) - h.at(n - 1))), norm(h.at(n + 2) - h.at(n + 1) - change));
  return uneven <= 0.25 * norm(change) + known_rate(h, n);
}

/// Whether the frames are fine enough to show a quarter of a step.
bool is_resolved(const History& h, std::size_t n) {
  if ((touches(h, n - 1) || touches(h, n) || touches(h, n + 1)) && !is_even(h, n)) return false;
  const double quarter_step = 0.25 * h.step(n) / h.time(n) * norm(h.at(n + 1) - h.at(n));
  return norm(bend(h, n)) <= quarter_step + known_rate(h, n);
}

/// Mean rate by the way or turn of an interval, less that by the rates of its frames.
Vec3 off_rate(const History& h, std::size_t n) {
  const BodyState &a = h.state(n), &b = h.state(n + 1);
  const Vec3 first = h.at(n) + bend(h, n), last = h.at(n + 1) + bend(h, n);
  const double time = h.time(n);
  if (!h.turns())
    return (1.0 / time) *
           displacement(h.run.job.scene, b.position, a.position + (0.5 * time) * (first + last));
  const Quaternion turn = b.orientation * conjugate(a.orientation);
  return (1.0 / time) * rotation_vector(turn * conjugate(linear_turn(first, last, time)));
}

/// Intervals that say something of a lag.
std::vector<std::size_t> telling_intervals(const History& h) {
  const std::size_t intervals = h.run.frames.size() - 1;
  std::vector<char> smooth;
  for (std::size_t n = 0; n < intervals; ++n) smooth.push_back(is_smooth(h, n) ? 1 : 0);
  std::vector<std::size_t> list;
  for (std::size_t n = 1; n + 1 < intervals; ++n)
    if (smooth[n - 1] != 0 && smooth[n] != 0 && smooth[n + 1] != 0 && is_resolved(h, n)) list.push_back(n);
  return list;
}

/// Whether all that the places show otherwise than the rates in contact may be a push out of other bodies.
bool may_be_pushed_out(const History& h, const std::vector<std::size_t>& intervals) {
  double way = 0.0;
  for (const std::size_t n : intervals)
    if (touches(h, n)) way += norm(off_rate(h, n)) * h.time(n) * h.length;
  const auto body = static_cast<std::size_t>(&h.body - h.run.job.bodies.data());
  return way > 0.0 && way <= depth_of_hits(h.run, body) + depth_at_start(h.run, body);
}

Fit fit_of(const History& h) {
  const auto intervals = telling_intervals(h);
  const bool in_flight_alone = may_be_pushed_out(h, intervals);
  Fit fit;
  for (const std::size_t n : intervals)
    if (!in_flight_alone || !touches(h, n))
      fit.take(off_rate(h, n), (1.0 / h.time(n)) * (h.at(n + 1) - h.at(n)), 0.5 * (h.at(n) + h.at(n + 1)));
  return fit;
}

Vec3 angular_momentum(const BodyState& b, const MassProperties& p, const Vec3& spin) {
  const Quaternion axes = b.orientation * p.principal_axes;
  const Vec3 w = rotate_back(axes, spin), &i = p.principal_inertia;
  return rotate(axes, {i.x * w.x, i.y * w.y, i.z * w.z});
}

bool never_touches(const History& h) {
  for (std::size_t n = 0; n + 1 < h.run.frames.size(); ++n)
    if (touches(h, n)) return false;
  return true;
}

/// Whether a free body's angular momentum is kept ten times better where the angular velocities are shifted
/// by their lag. A scheme that is itself half a step behind changes it, however shifted.
bool is_kept_when_shifted(const History& h, double lag) {
  double as_it_is = 0.0, shifted = 0.0;
  const auto& p = h.body.properties;
  const Vec3 start = angular_momentum(h.state(0), p, h.at(0));
  for (std::size_t n = 1; n + 1 < h.run.frames.size(); ++n) {
    const Vec3 slope = (1.0 / (h.time(n - 1) + h.time(n))) * (h.at(n + 1) - h.at(n - 1));
    as_it_is = std::max(as_it_is, norm(angular_momentum(h.state(n), p, h.at(n)) - start));
    shifted = std::max(shifted, norm(angular_momentum(h.state(n), p, h.at(n) - lag * slope) - start));
  }
  return shifted < 0.1 * as_it_is;
}

constexpr double half_a_step = 0.6, quarter_step = 0.25, known_to = 0.05;  // of a step, with room for the fit
constexpr double largest_share = 3e-4, share_known_to = 5e-5;
/// A joint bends the path within a step: a scheme of second order leaves (omega h)^2/12, and one that returns
/// bodies to their joints by places is a step behind with the velocities.
constexpr double share_of_tied = 2e-3, a_step = 1.1;

std::string contradiction(const History& h) {
  const Fit fit = fit_of(h);
  const Fitted lag = fit.lag(), share = fit.share();
  const double step = h.step(0);
  const std::string what =
      "contradicts itself: the " + std::string(h.turns() ? "turns" : "places") + " of `" + h.body.name + "` ";
  const std::string rate = h.turns() ? "angular velocities" : "velocities";
  const bool tied = is_tied(h.run.job.scene, h.body.name);
  const double of_scheme = (h.turns() ? 0.15 * step * step * fit.mean_square_rate() : 0.0) +  // second order
                           (tied ? share_of_tied : 0.0);
  if (share.error < share_known_to && share.is_beyond(largest_share + of_scheme))
    return what + "change by " + figure(1.0 + share.value) + " of what its " + rate + " say";
  const bool is_known = lag.error < known_to * step && fit.effect(step) > 1e-3;
  const bool is_late = lag.is_beyond((tied ? a_step : half_a_step) * step) ||
                       (h.turns() && lag.is_beyond(quarter_step * step) && never_touches(h) &&
                        is_kept_when_shifted(h, lag.value));
  if (!is_known || !is_late) return {};
  return what + "are " + figure(0.01 * std::round(100.0 * std::abs(lag.value) / step)) + " steps " +
         (lag.value > 0.0 ? "behind" : "ahead of") + " its " + rate;
}

}  // namespace

std::string lags_behind_its_rate(const Audited& run) {
  if (!keeps_bodies(run.job) || run.frames.size() < 2) return {};
  for (const auto& b : run.job.bodies) {
    if (!is_followed(run, b)) continue;
    for (const History& h : {History{run, b, &BodyState::velocity, 1.0},
                             History{run, b, &BodyState::angular_velocity, gyration_radius(b)}})
      if (auto why = contradiction(h); !why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
