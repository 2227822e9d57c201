// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/members.hpp"
#include "validation/metrics/solid_motion.hpp"

namespace tripoint {
namespace {

/// Least-squares line through (t, y): slope and its standard error.
struct Line {
  double slope = not_a_number, error = 0.0;
};
/// Neighbours in time deviate from the line alike. The number of independent deviations follows from the
/// changes of sign: n independent ones change sign at half of the steps. Frames in between then add no
/// certainty.
Line fit(const std::vector<double>& t, const std::vector<double>& y) {
  const double n = static_cast<double>(t.size());
  double t0 = 0.0, y0 = 0.0, tt = 0.0, ty = 0.0, rest = 0.0, last = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    t0 += t[i] / n;
    y0 += y[i] / n;
  }
  for (std::size_t i = 0; i < t.size(); ++i) {
    tt += (t[i] - t0) * (t[i] - t0);
    ty += (t[i] - t0) * (y[i] - y0);
  }
  double independent = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double off = y[i] - y0 - ty / tt * (t[i] - t0);
    rest += off * off;
    if (off * last < 0.0) independent += 2.0;
    last = off;
  }
  return {ty / tt, n > 2.0 ? std::sqrt(rest / (std::clamp(independent, 3.0, n) - 2.0) / tt) : 0.0};
}

// --- a body's motion along an axis

/// Speeds of the metric's body along the reference's axis; the reason why there are none, or an empty text.
std::string speeds(const MetricInput& in, const Frames& frames, std::vector<double>& t,
                   std::vector<double>& v) {
  const auto axis = in.reference.measuring().axis;
  const long row = body_row(in);
  if (!axis) return "the reference names no axis";
  if (row < 0) return "the metric must name a solid body";
  for (const auto* s : frames) {
    if (static_cast<std::size_t>(row) >= s->bodies.size() ||
        !finite(s->bodies[static_cast<std::size_t>(row)].velocity))
      return "the trajectory does not have the body";
    t.push_back(s->time);
    v.push_back(s->bodies[static_cast<std::size_t>(row)].velocity[*axis]);
  }
  return t.size() < 3 ? "three output times or more are needed" : "";
}

MetricValue acceleration(const MetricInput& in, const Frames& frames) {
  const auto truth = number_or_value(in, "acceleration"), up = in.reference.number("up");
  if (!truth) return unformed("the reference does not know the acceleration");
  std::vector<double> t, v;
  if (auto why = speeds(in, frames, t, v); !why.empty()) return unformed(why);
  const auto line = fit(t, v);
  MetricValue value;
  value.value = up.value_or(1.0) * line.slope - *truth;
  value.uncertainty.numerical = line.error;
  return value;
}

/// The touch is where the speed has made half of its change, between frames by a straight line.
MetricValue touch_time(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("touch_time");
  if (!truth) return unformed("the reference does not know a time of touch");
  std::vector<double> t, v;
  if (auto why = speeds(in, frames, t, v); !why.empty()) return unformed(why);
  const double half = 0.5 * (v.front() + v.back());
  if (v.front() == v.back()) return unformed("the body's speed does not change: no touch");
  for (std::size_t n = 1; n < t.size(); ++n) {
    if ((v[n - 1] - half) * (v[n] - half) > 0.0) continue;
    MetricValue value;
    value.value = t[n - 1] + (half - v[n - 1]) / (v[n] - v[n - 1]) * (t[n] - t[n - 1]) - *truth;
    value.uncertainty.numerical = (t[n] - t[n - 1]) / std::sqrt(12.0);
    return value;
  }
  return unformed("the body's speed never passes the middle of its change");
}

// --- a standing wave

/// Which way the particles of a standing wave swing: as the reference says, else along the wave vector.
Vec3 swing_direction(const MetricInput& in, const Vec3& k) {
  const auto wave = in.reference.measuring().wave;
  return wave && wave->polarisation ? *wave->polarisation : (1.0 / norm(k)) * k;
}

/// Amplitude of the mode in the velocities along a direction, at the particles' own places.
double mode_amplitude(const MetricInput& in, const Snapshot& s, const Vec3& k, double phase) {
  const Vec3 direction = swing_direction(in, k);
  long double product = 0, square = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (!takes_free(in, i)) continue;
    const double shape = std::cos(dot(k, s.position[i]) + phase), w = rest_volume(in, i);
    product += static_cast<long double>(w) * shape * dot(s.velocity[i], direction);
    square += static_cast<long double>(w) * shape * shape;
  }
  return double(product / square);
}

/// Square of the mode's frequency over the true one, minus 1. A damped swing a(t) at equal times follows
/// a[n+1] + q a[n-1] = 2 sqrt(q) cos(w dt) a[n] (Prony's method). Both coefficients are found by least
/// squares.
MetricValue frequency_squared(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("frequency");
  const auto wave = in.reference.measuring().wave;
  if (!truth || !wave) return unformed("the reference does not know the frequency of a wave");
  if (frames.size() < 6) return unformed("a frequency needs six output times or more");
  std::vector<double> a;
  for (const auto* s : frames) a.push_back(mode_amplitude(in, *s, wave->wave_vector, wave->phase));
  double ss = 0.0, sp = 0.0, pp = 0.0, sn = 0.0, pn = 0.0;  // of now, previous and next
  for (std::size_t n = 1; n + 1 < a.size(); ++n) {
    ss += a[n] * a[n];
    sp += a[n] * a[n - 1];
    pp += a[n - 1] * a[n - 1];
    sn += a[n] * a[n + 1];
    pn += a[n - 1] * a[n + 1];
  }
  const double determinant = ss * pp - sp * sp, b = (sn * pp - pn * sp) / determinant,
               q = -(pn * ss - sn * sp) / determinant;
  const double cosine = 0.5 * b / std::sqrt(q),
               step = (frames.back()->time - frames.front()->time) / static_cast<double>(frames.size() - 1);
  if (!(q > 0.0) || !(std::abs(cosine) < 1.0)) return unformed("the mode does not swing");
  const double w = std::acos(cosine) / step;
  MetricValue v;
  v.value = w * w / (*truth * *truth) - 1.0;
  v.note = "frequency " + std::to_string(w) + " rad/s against " + std::to_string(*truth) + ", damping " +
           std::to_string(-0.5 * std::log(q) / step) + " 1/s";
  return v;
}

// --- a spinning liquid

double spin_of(const MetricInput& in, const Snapshot& s) {
  double mass = 0.0;
  Vec3 centre, momentum, L;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (!takes_free(in, i)) continue;
    const double m = in.initial.mass[i];
    mass += m;
    centre += m * s.position[i];
    momentum += m * s.velocity[i];
    L += m * cross(s.position[i], s.velocity[i]);
  }
  return norm(L - (1.0 / mass) * cross(centre, momentum));
}

MetricValue spin_rate(const MetricInput& in, const Frames& frames) {
  const auto truth = number_or_value(in, "spin_rate");
  if (!truth) return unformed("the reference does not know how a spin decays");
  if (frames.size() < 2) return unformed("a rate needs two output times or more");
  std::vector<double> t, y;
  for (const auto* s : frames) {
    t.push_back(s->time);
    y.push_back(std::log(spin_of(in, *s)));
  }
  const auto line = fit(t, y);
  MetricValue v;
  v.value = -line.slope - *truth;
  v.uncertainty.numerical = line.error;
  return v;
}

/// Frequency of the centre of mass of the metric's body along the stated axis: a sine about an offset by
/// least squares.
MetricValue sway_frequency(const MetricInput& in, const Frames& frames) {
  const auto axis = in.reference.measuring().axis;
  const auto truth = in.reference.number("value");
  if (!axis || !truth) return unformed("the reference states no axis, or no frequency as its value");
  if (frames.size() < 8) return unformed("a swing needs eight output times or more");
  std::vector<double> t, y;
  for (const auto* s : frames) {
    double mass = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < in.initial.size(); ++i)
      if (takes(in, i)) {
        mass += in.initial.mass[i];
        moment +=
            in.initial.mass[i] * displacement(in.job.scene, s->position[i], in.initial.position[i])[*axis];
      }
    t.push_back(s->time);
    y.push_back(moment / mass);
  }
  const Swing swing = fit_swing(t, y, 2.0 * std::numbers::pi * *truth);
  if (!swing.problem.empty()) return unformed(swing.problem);
  MetricValue v;
  v.value = swing.frequency / (2.0 * std::numbers::pi * *truth) - 1.0;
  v.note = std::to_string(swing.frequency / (2.0 * std::numbers::pi)) + " Hz against " +
           std::to_string(*truth) + ", amplitude " + std::to_string(swing.amplitude) + " m";
  return v;
}

}  // namespace

const std::vector<RunQuantity>& motion_quantities() {
  static const std::vector<RunQuantity> list{
      {{"acceleration", "m/s2",
        "acceleration of the body against gravity or along the stated axis, by least squares over the "
        "window, minus the true "
        "one"},
       acceleration},
      {{"touch_time", "s",
        "time at which the body's speed has made half of its change minus the true time of touch"},
       touch_time},
      {{"frequency_squared", "1", "square of the standing wave's frequency over the true one, minus 1"},
       frequency_squared},
      {{"spin_rate", "1/s",
        "rate at which the angular momentum about the centre of mass falls, minus the true one"},
       spin_rate},
      {{"sway_frequency", "1",
        "frequency of the body's centre along the stated axis, by a fitted sine, over the stated value in "
        "Hz, minus 1"},
       sway_frequency}};
  return list;
}

}  // namespace tripoint
