// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/frames.hpp"

namespace tripoint {
namespace {

// --- decay rate

/// Amplitude of the mode in one frame [K], least squares with volume weights, and its standard error.
struct Amplitude {
  double value = not_a_number, sigma = 0.0;
};

/// The mode at the particles, less its own mean: a uniform temperature has no amplitude.
std::vector<double> mode_shape(const MetricInput& in, const Vec3& k, double phase) {
  std::vector<double> shape;
  long double mean = 0, weight = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    shape.push_back(takes(in, i) ? std::cos(dot(k, in.initial.position[i]) + phase) : 0.0);
    const double w = takes(in, i) ? rest_volume(in, i) : 0.0;
    mean += w * shape.back();
    weight += w;
  }
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i] -= takes(in, i) ? double(mean / weight) : 0.0;
  return shape;
}

Amplitude project(const MetricInput& in, const Snapshot& s, const std::vector<double>& shape) {
  long double product = 0, square = 0, variance = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (!takes(in, i)) continue;
    const double w = rest_volume(in, i);
    product += static_cast<long double>(w) * shape[i] * s.temperature[i];
    square += static_cast<long double>(w) * shape[i] * shape[i];
    // Standard errors are taken as fully correlated here (layers share one count): an upper bound.
    if (!s.temperature_error.empty())
      variance += static_cast<long double>(w) * std::abs(shape[i]) * s.temperature_error[i];
  }
  return {double(product / square), double(variance / square)};
}

/// Rate of ln amplitude over time by least squares. The frames of one run of walkers are correlated, so their
/// standard errors are added by size, not in squares: an upper bound.
MetricValue decay_rate(const MetricInput& in, const Frames& frames) {
  const auto rate = in.reference.number("decay_rate");
  const auto wave = in.reference.measuring().wave;
  if (!rate || !wave) return unformed("the reference does not know the decay rate of a mode");
  if (frames.size() < 2) return unformed("a rate needs two output times or more");
  const auto shape = mode_shape(in, wave->wave_vector, wave->phase);
  std::vector<double> t, y, u;
  double sign = 1.0;  // of the first amplitude
  for (const auto* s : frames) {
    if (s->temperature.size() != in.initial.size())
      return unformed("the trajectory has no temperature of all particles");
    const auto a = project(in, *s, shape);
    if (y.empty() && a.value < 0.0) sign = -1.0;
    if (!(sign * a.value > 0.0))
      return unformed("the mode has no amplitude of its first sign at t = " + std::to_string(s->time) + " s");
    t.push_back(s->time);
    y.push_back(std::log(sign * a.value));
    u.push_back(a.sigma / std::abs(a.value));
  }
  double mean = 0.0, tt = 0.0, ty = 0.0, spread = 0.0;
  for (const double x : t) mean += x / static_cast<double>(t.size());
  for (std::size_t n = 0; n < t.size(); ++n) {
    tt += (t[n] - mean) * (t[n] - mean);
    ty += (t[n] - mean) * y[n];
    spread += std::abs(t[n] - mean) * u[n];
  }
  MetricValue v;
  v.value = -ty / tt / *rate - 1.0;
  v.uncertainty.statistical = spread / tt / *rate;
  v.note = "rate " + std::to_string(-ty / tt) + " 1/s against " + std::to_string(*rate);
  return v;
}

// --- events

/// Spin of a body along its middle principal axis and its rate by Euler's equation.
struct MiddleSpin {
  double w, rate;
};
MiddleSpin middle_spin(const BodyState& b, const MassProperties& p) {
  const Vec3 w = rotate_back(p.principal_axes, rotate_back(b.orientation, b.angular_velocity)),
             I = p.principal_inertia;
  return {w.y, (I.z - I.x) / I.y * w.z * w.x};
}

/// Root of the cubic through both ends with their rates: error (frame interval)^4.
double hermite_root(const MiddleSpin& a, const MiddleSpin& b, double t0, double t1) {
  const double h = t1 - t0;
  const auto value = [&](double s) {
    return (1 + 2 * s) * (1 - s) * (1 - s) * a.w + s * (1 - s) * (1 - s) * h * a.rate +
           s * s * (3 - 2 * s) * b.w + s * s * (s - 1) * h * b.rate;
  };
  double low = 0.0, high = 1.0;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (value(middle) * a.w > 0.0 ? low : high) = middle;
  }
  return t0 + 0.5 * (low + high) * h;
}

/// Times at which a run's body flips; empty text or what hinders.
std::string find_flips(const MetricInput& in, const Frames& frames, std::size_t row,
                       std::vector<double>& times) {
  const JobBody* body = nullptr;
  for (const auto& b : in.job.bodies)
    if (b.index == static_cast<int>(row)) body = &b;
  if (!body) return "the reference's body is not in the job";
  double sign = 0.0;  // of the last spin that was not zero: a spin that begins at zero has not flipped
  for (std::size_t n = 0; n < frames.size(); ++n) {
    if (row >= frames[n]->bodies.size()) return "the trajectory does not have the body";
    const auto now = middle_spin(frames[n]->bodies[row], body->properties);
    if (!std::isfinite(now.w))
      return "the body's spin is not finite at t = " + std::to_string(frames[n]->time) + " s";
    if (now.w == 0.0) continue;
    if (sign * now.w < 0.0) {
      const auto before = middle_spin(frames[n - 1]->bodies[row], body->properties);
      times.push_back(hermite_root(before, now, frames[n - 1]->time, frames[n]->time));
    }
    sign = now.w;
  }
  return {};
}

std::size_t bodies_alive(const Snapshot& s) {
  return static_cast<std::size_t>(
      std::count_if(s.bodies.begin(), s.bodies.end(), [](const BodyState& b) { return finite(b.position); }));
}

/// Bodies before the first frame: of the job where that frame is the start, in which an event at 0 s may have
/// happened already.
std::size_t bodies_before(const MetricInput& in, const Snapshot& first) {
  if (first.time > in.job.times.front() + time_tolerance(in.job)) return bodies_alive(first);
  return static_cast<std::size_t>(
      std::ranges::count_if(in.job.bodies, [](const JobBody& b) { return b.index >= 0; }));
}

/// A merge or split shows between two frames: the error is the distance of the true time from that interval.
MetricValue count_change_time(const MetricInput& in, const Frames& frames, double truth) {
  const auto before = bodies_before(in, *frames.front());
  for (std::size_t n = 0; n < frames.size(); ++n) {
    if (bodies_alive(*frames[n]) == before) continue;
    const double from = frames[n == 0 ? 0 : n - 1]->time, to = frames[n]->time;
    MetricValue v;
    v.value = from > truth ? from - truth : to < truth ? to - truth : 0.0;
    v.uncertainty.numerical = (to - from) / std::sqrt(12.0);
    v.note = "resolved by the output interval";
    return v;
  }
  return unformed("the number of bodies never changes: the event did not happen");
}

MetricValue event_time(const MetricInput& in, const Frames& frames) {
  auto truth = in.reference.number("event_time");
  const auto row = in.reference.measuring().flip_body;
  if (!truth) truth = in.reference.number("value");
  if (!truth) return unformed("the reference does not know the time of an event");
  if (!row) return count_change_time(in, frames, *truth);
  std::vector<double> times;
  if (auto why = find_flips(in, frames, *row, times); !why.empty()) return unformed(why);
  if (times.empty()) return unformed("the body never flips");
  MetricValue v;
  v.value = times.front() - *truth;
  v.note = std::to_string(times.size()) + " flips, the first at " + std::to_string(times.front()) + " s";
  return v;
}

MetricValue event_count(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("flip_count");
  const auto row = in.reference.measuring().flip_body;
  if (!truth || !row) return unformed("the reference does not know the number of events");
  std::vector<double> times;
  if (auto why = find_flips(in, frames, *row, times); !why.empty()) return unformed(why);
  MetricValue v;
  v.value = static_cast<double>(times.size()) - *truth;
  return v;
}

}  // namespace

const std::vector<RunQuantity>& run_quantities() {
  static const std::vector<RunQuantity> list{
      {{"decay_rate", "1", "rate at which the reference's mode decays, over the true rate, minus 1"},
       decay_rate},
      {{"event_time", "s", "time of the first event (flip, merge, split) minus the true one"}, event_time},
      {{"event_count", "1", "number of flips in the run minus the true one"}, event_count}};
  return list;
}

}  // namespace tripoint
