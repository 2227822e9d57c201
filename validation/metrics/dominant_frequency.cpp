// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/dominant_frequency.hpp"

#include <cmath>
#include <Eigen/Dense>
#include <numbers>

namespace tripoint {
namespace {

constexpr double least_periods = 1.5, least_samples_a_period = 4.0, steps_a_period = 20.0;
constexpr double least_share = 0.5;  ///< of the variance: a sine that explains less is no frequency

/// Offset, cosine and sine at one frequency, and the sum of squares that is left.
struct Fit {
  Eigen::Vector3d coefficients;
  double rest = 0.0;
};

Fit fit_at(const std::vector<double>& t, const std::vector<double>& y, double frequency) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double square = 0.0;
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double angle = 2.0 * std::numbers::pi * frequency * (t[n] - t.front());
    const Eigen::Vector3d basis(1.0, std::cos(angle), std::sin(angle));
    A += basis * basis.transpose();
    b += y[n] * basis;
    square += y[n] * y[n];
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  return {x, std::max(0.0, square - x.dot(b))};
}

DominantFrequency none(const std::string& why) {
  DominantFrequency d;
  d.problem = why;
  return d;
}

}  // namespace

DominantFrequency dominant_frequency(const std::vector<double>& time, const std::vector<double>& value) {
  const auto count = static_cast<double>(time.size());
  if (time.size() < 8) return none("a frequency needs eight output times or more in its window");
  const double length = time.back() - time.front(), highest = (count - 1.0) / length / least_samples_a_period,
               lowest = least_periods / length;
  double mean = 0.0, variance = 0.0, largest = 0.0;
  for (const double y : value) {
    mean += y / count;
    largest = std::max(largest, std::abs(y));
  }
  std::vector<double> y;
  for (const double one : value) {
    y.push_back(one - mean);
    variance += y.back() * y.back();
  }
  if (!std::isfinite(variance)) return none("the quantity is not finite at all output times of the window");
  if (!(variance > 1e-24 * largest * largest * count))
    return none("the quantity does not change: it has no frequency");
  if (!(highest > lowest)) return none("the window has too few output times for a frequency");
  const double step = 1.0 / (steps_a_period * length);
  const auto steps = static_cast<int>((highest - lowest) / step);
  int best = 0;
  double least = fit_at(time, y, lowest).rest;
  for (int n = 1; n <= steps; ++n)
    if (const double rest = fit_at(time, y, lowest + n * step).rest; rest < least) {
      least = rest;
      best = n;
    }
  if (best == 0 || best == steps)
    return none(
        "the quantity swings less than one and a half times in the window, or too fast for its output times: "
        "lengthen the window "
        "or shorten output_interval");
  double low = lowest + (best - 1) * step, high = lowest + (best + 1) * step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int n = 0; n < 60; ++n) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (fit_at(time, y, a).rest < fit_at(time, y, b).rest)
      high = b;
    else
      low = a;
  }
  DominantFrequency d;
  d.frequency = 0.5 * (low + high);
  const Fit fit = fit_at(time, y, d.frequency);
  d.amplitude = std::hypot(fit.coefficients[1], fit.coefficients[2]);
  d.share = 1.0 - fit.rest / variance;
  if (d.share < least_share)
    return none("no single frequency stands out: the best sine explains " + std::to_string(100.0 * d.share) +
                " % of the variance");
  d.uncertainty = std::sqrt(6.0 / count) * std::sqrt(fit.rest / (count - 4.0)) /
                  (std::numbers::pi * length * d.amplitude);
  return d;
}

}  // namespace tripoint
