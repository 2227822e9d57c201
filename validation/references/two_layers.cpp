// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/two_layers.hpp"

#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

using std::numbers::pi;

double mode_frequency(const TwoLayers& s, int n) {
  const double a = s.length_low / std::sqrt(s.diffusivity_low), b = s.length_high / std::sqrt(s.diffusivity_high);
  const auto residual = [&](double w) {
    return s.effusivity_low * std::sin(w * a) * std::cos(w * b) + s.effusivity_high * std::cos(w * a) * std::sin(w * b);
  };
  const double low = (n - 0.5) * pi / (a + b), high = (n + 0.5) * pi / (a + b);
  std::uintmax_t steps = 100;
  const auto root = boost::math::tools::toms748_solve(residual, low, high, boost::math::tools::eps_tolerance<double>(52), steps);
  return 0.5 * (root.first + root.second);
}

/// One mode, normalised by its amplitude at the interface from each side: low part A cos(p x1/L1), high part B cos(q x2/L2) with
/// A cos p = B cos q and e1 A sin p = -e2 B sin q; the pair that does not vanish is used.
struct Mode {
  double A, B;
};
Mode mode_shape(const TwoLayers& s, double p, double q) {
  if (std::hypot(std::cos(p), std::cos(q)) > 0.1) return {std::cos(q), std::cos(p)};
  return {s.effusivity_high * std::sin(q), -s.effusivity_low * std::sin(p)};
}

}  // namespace

double half_spaces_in_contact(const TwoLayers& s, double x, double time) {
  const bool low = x < s.interface;
  const double start = low ? s.start_low : s.start_high;
  if (time <= 0.0) return start;
  const double contact = (s.effusivity_low * s.start_low + s.effusivity_high * s.start_high) / (s.effusivity_low + s.effusivity_high);
  const double D = low ? s.diffusivity_low : s.diffusivity_high;
  return start + (contact - start) * std::erfc(std::abs(x - s.interface) / std::sqrt(4.0 * D * time));
}

double eigenfunction_series(const TwoLayers& s, double x, double time) {
  const double a = s.length_low / std::sqrt(s.diffusivity_low), b = s.length_high / std::sqrt(s.diffusivity_high);
  // Heat capacity per area of a layer, in units in which rho c_p = e/sqrt D: weights of the mean and of the projection.
  const double low_capacity = s.effusivity_low * a, high_capacity = s.effusivity_high * b;
  double sum = (low_capacity * s.start_low + high_capacity * s.start_high) / (low_capacity + high_capacity);
  const bool low = x < s.interface;
  const double from_end = low ? x - (s.interface - s.length_low) : s.interface + s.length_high - x;
  for (int n = 1;; ++n) {
    const double w = mode_frequency(s, n), p = w * a, q = w * b;
    if (w * w * time > 45.0) return sum;  // exp(-45) = 3e-20
    const auto [A, B] = mode_shape(s, p, q);
    const double norm2 = low_capacity * A * A * (0.5 + 0.25 * std::sin(2.0 * p) / p) + high_capacity * B * B * (0.5 + 0.25 * std::sin(2.0 * q) / q);
    const double share = (low_capacity * s.start_low * A * std::sin(p) / p + high_capacity * s.start_high * B * std::sin(q) / q) / norm2;
    const double shape = low ? A * std::cos(p * from_end / s.length_low) : B * std::cos(q * from_end / s.length_high);
    sum += share * shape * std::exp(-w * w * time);
  }
}

double temperature_of(const TwoLayers& s, double x, double time) {
  const double reach_low = s.length_low / std::sqrt(s.diffusivity_low), reach_high = s.length_high / std::sqrt(s.diffusivity_high);
  const bool short_time = std::min(reach_low, reach_high) > 6.0 * std::sqrt(4.0 * time);
  return short_time ? half_spaces_in_contact(s, x, time) : eigenfunction_series(s, x, time);
}

}  // namespace tripoint
