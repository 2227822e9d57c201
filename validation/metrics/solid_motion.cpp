// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/solid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

namespace tripoint {
namespace {

/// Where the bar's material begins and ends along its axis at the start [m].
struct Extent {
  std::size_t bar = 0, axis = 0;
  double low = 0.0, high = 0.0;
};

Extent extent_of(const MetricInput& in) {
  const auto measuring = in.reference.measuring();
  if (!measuring.axis)
    throw InputError(in.choice.place, "metric `" + in.choice.name + "`: its reference names no axis");
  Extent e{measuring.bar ? *measuring.bar : job_body(in), *measuring.axis, 1e300, -1e300};
  const double half = 0.5 * in.job.scene.spacing;
  for (const auto i : sampled(in, e.bar)) {
    const double x = in.initial.position[i][e.axis];
    e.low = std::min(e.low, x - half);
    e.high = std::max(e.high, x + half);
  }
  return e;
}

/// Particles of the bar that began between two places on its axis.
std::vector<std::size_t> layer(const MetricInput& in, const Extent& e, double from, double to) {
  const double round_off = 1e-9 * in.job.scene.spacing;
  std::vector<std::size_t> list;
  for (const auto i : sampled(in, e.bar)) {
    const double x = in.initial.position[i][e.axis];
    if (x > from + round_off && x <= to + round_off) list.push_back(i);
  }
  return list;
}

/// Mean displacement since the start.
Vec3 moved(const MetricInput& in, const Snapshot& s, const std::vector<std::size_t>& particles) {
  Vec3 sum;
  for (const auto i : particles) sum += displacement(in.job.scene, s.position[i], in.initial.position[i]);
  return (1.0 / static_cast<double>(particles.size())) * sum;
}

Vec3 mean_start(const MetricInput& in, const std::vector<std::size_t>& particles) {
  Vec3 sum;
  for (const auto i : particles) sum += in.initial.position[i];
  return (1.0 / static_cast<double>(particles.size())) * sum;
}

Measured unknown(const std::string& why) { return {not_a_number, why, false}; }

/// Least squares of offset, cosine and sine at one frequency: the three coefficients and the residual.
std::pair<Eigen::Vector3d, double> at_frequency(const std::vector<double>& t, const std::vector<double>& y,
                                                double w) {
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixX3d A(n, 3);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = w * (t[static_cast<std::size_t>(i)] - t.front());
    A.row(i) << 1.0, std::cos(angle), std::sin(angle);
    b[i] = y[static_cast<std::size_t>(i)];
  }
  const Eigen::Vector3d x = A.colPivHouseholderQr().solve(b);
  return {x, (A * x - b).squaredNorm()};
}

}  // namespace

Measured deflection(const MetricInput& in, const Snapshot& s) {
  const auto measuring = in.reference.measuring();
  if (!measuring.direction) return unknown("the reference knows no direction of deflection");
  const Vec3 direction = *measuring.direction;
  const long row = body_row(in);
  if (row >= 0 && in.job.bodies[job_body(in)].phase == Phase::rigid) {
    if (static_cast<std::size_t>(row) >= s.bodies.size() ||
        !finite(s.bodies[static_cast<std::size_t>(row)].position))
      return unknown("the trajectory does not have the body");
    return {dot(direction, displacement(in.job.scene, s.bodies[static_cast<std::size_t>(row)].position,
                                        in.job.bodies[job_body(in)].properties.centre)),
            "", true};
  }
  if (!measuring.free_end_is_high) return unknown("the reference knows no free end");
  const auto e = extent_of(in);
  const double dx = in.job.scene.spacing;
  const auto last =
      *measuring.free_end_is_high ? layer(in, e, e.high - dx, e.high) : layer(in, e, e.low, e.low + dx);
  return last.empty() ? unknown("the bar has no particles at its free end")
                      : Measured{dot(direction, moved(in, s, last)), "", false};
}

Measured stretch(const MetricInput& in, const Snapshot& s, double gauge) {
  const auto e = extent_of(in);
  const double dx = in.job.scene.spacing, cut = 0.5 * (1.0 - gauge) * (e.high - e.low);
  const auto low = layer(in, e, e.low + cut, e.low + cut + dx),
             high = layer(in, e, e.high - cut - dx, e.high - cut);
  if (low.empty() || high.empty()) return unknown("the body has no particles at the ends of the gauge");
  const Vec3 start = mean_start(in, high) - mean_start(in, low),
             now = start + moved(in, s, high) - moved(in, s, low);
  return norm(start) > 0.0 ? Measured{norm(now) / norm(start), "", false}
                           : unknown("the gauge is shorter than two layers");
}

Measured reaction(const MetricInput& in, const Snapshot& s) {
  const long row = body_row(in);
  if (row < 0 || static_cast<std::size_t>(row) >= s.bodies.size())
    return unknown("reaction: the metric must name the held body");
  const auto measuring = in.reference.measuring();
  if ((measuring.bar ? *measuring.bar : job_body(in)) == job_body(in))
    return unknown(
        "reaction: the metric must name the body that holds the bar, and the reference the bar: with a "
        "stated value that is "
        "the quantity `force` along an axis");
  const auto e = extent_of(in);
  const double side =
      in.job.bodies[job_body(in)].properties.centre[e.axis] < 0.5 * (e.low + e.high) ? 1.0 : -1.0;
  const double force = s.bodies[static_cast<std::size_t>(row)].force[e.axis];
  return std::isfinite(force) ? Measured{side * force, "", false}
                              : unknown("the trajectory has no force on the body");
}

Swing fit_swing(const std::vector<double>& t, const std::vector<double>& y, double guess) {
  const auto rest = [&](double w) { return at_frequency(t, y, w).second; };
  const int count = 200;
  const auto place = [&](double n) { return 0.4 * guess * std::pow(2.5 / 0.4, n / count); };
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n <= count; ++n)
    if (const double r = rest(place(n)); r < least) {
      least = r;
      best = n;
    }
  if (best == 0 || best == count)
    return {0, 0, 0, "the swing's frequency is not between 0.4 and 2.5 of the true one"};
  double low = place(best - 1), high = place(best + 1);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int n = 0; n < 50; ++n) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (rest(a) < rest(b))
      high = b;
    else
      low = a;
  }
  const double w = 0.5 * (low + high);
  const auto x = at_frequency(t, y, w).first;
  return {x[0], std::hypot(x[1], x[2]), w, ""};
}

}  // namespace tripoint
