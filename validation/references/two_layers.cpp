// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/two_layers.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

using std::numbers::pi;
constexpr double negligible = 45.0;  // exp(-45) = 3e-20

}  // namespace

TwoLayerSolution::TwoLayerSolution(const TwoLayers& s)
    : s_(s),
      reach_low_(s.length_low / std::sqrt(s.diffusivity_low)),
      reach_high_(s.length_high / std::sqrt(s.diffusivity_high)) {
  // Heat capacity per area of a layer is e L/sqrt D, up to a factor that both share.
  const double low = s.effusivity_low * reach_low_, high = s.effusivity_high * reach_high_;
  mean_ = (low * s.start_low + high * s.start_high) / (low + high);
  switch_time_ = std::pow(std::min(reach_low_, reach_high_) / 12.0, 2);
  for (int n = 1; modes_.empty() || modes_.back().w * modes_.back().w * 0.25 * switch_time_ <= negligible;
       ++n)
    modes_.push_back(mode(n));
}

TwoLayerSolution::Mode TwoLayerSolution::mode(int n) const {
  const double e1 = s_.effusivity_low, e2 = s_.effusivity_high, a = reach_low_, b = reach_high_;
  const auto residual = [&](double w) {
    return e1 * std::sin(w * a) * std::cos(w * b) + e2 * std::cos(w * a) * std::sin(w * b);
  };
  std::uintmax_t steps = 100;
  const auto root =
      boost::math::tools::toms748_solve(residual, (n - 0.5) * pi / (a + b), (n + 0.5) * pi / (a + b),
                                        boost::math::tools::eps_tolerance<double>(52), steps);
  const double w = 0.5 * (root.first + root.second), p = w * a, q = w * b;
  // A cos p = B cos q keeps the temperature continuous, and e1 A sin p = -e2 B sin q the flux. The pair that
  // does not vanish is used.
  const bool cosines = std::hypot(std::cos(p), std::cos(q)) > 0.1;
  const double A = cosines ? std::cos(q) : e2 * std::sin(q), B = cosines ? std::cos(p) : -e1 * std::sin(p);
  const double square = e1 * a * A * A * (0.5 + 0.25 * std::sin(2.0 * p) / p) +
                        e2 * b * B * B * (0.5 + 0.25 * std::sin(2.0 * q) / q);
  const double share =
      (e1 * a * s_.start_low * A * std::sin(p) / p + e2 * b * s_.start_high * B * std::sin(q) / q) / square;
  return {w, share * A, share * B};
}

double TwoLayerSolution::half_spaces(double x, double time) const {
  const bool low = x < s_.interface;
  const double start = low ? s_.start_low : s_.start_high;
  if (time <= 0.0) return start;
  const double e1 = s_.effusivity_low, e2 = s_.effusivity_high,
               contact = (e1 * s_.start_low + e2 * s_.start_high) / (e1 + e2);
  const double D = low ? s_.diffusivity_low : s_.diffusivity_high;
  return start + (contact - start) * std::erfc(std::abs(x - s_.interface) / std::sqrt(4.0 * D * time));
}

double TwoLayerSolution::series(double x, double time) const {
  const bool low = x < s_.interface;
  const double from_end = low ? x - (s_.interface - s_.length_low) : s_.interface + s_.length_high - x;
  const double scaled = from_end / std::sqrt(low ? s_.diffusivity_low : s_.diffusivity_high);
  double sum = mean_;
  for (const auto& m : modes_) {
    if (m.w * m.w * time > negligible) break;
    sum += (low ? m.low : m.high) * std::cos(m.w * scaled) * std::exp(-m.w * m.w * time);
  }
  return sum;
}

double TwoLayerSolution::at(double x, double time) const {
  return time < switch_time_ ? half_spaces(x, time) : series(x, time);
}

}  // namespace tripoint
