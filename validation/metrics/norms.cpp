// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/norms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

using Real = long double;

double sum_of(const std::vector<double>& w) {
  Real sum = 0;
  for (const double x : w) sum += x;
  return double(sum);
}

/// sum w f(n) / sum w.
template <class F>
double mean_of(const FrameError& e, F f) {
  Real sum = 0;
  for (std::size_t n = 0; n < e.error.size(); ++n) sum += Real(e.weight[n]) * f(n);
  return double(sum / sum_of(e.weight));
}

double mean_square(const FrameError& e) {
  return mean_of(e, [&](std::size_t n) { return e.error[n] * e.error[n]; });
}

NormValue l2(const FrameError& e) {
  if (e.sigma.empty()) return {std::sqrt(mean_square(e)), 0.0, -1};
  const double noise = mean_of(e, [&](std::size_t n) { return e.sigma[n] * e.sigma[n]; });
  const double square = std::max(mean_square(e) - noise, 0.0), W = sum_of(e.weight);
  Real variance = 0;
  for (std::size_t n = 0; n < e.error.size(); ++n) {
    const double share = e.weight[n] / W, s2 = e.sigma[n] * e.sigma[n],
                 b2 = std::max(e.error[n] * e.error[n] - s2, 0.0);
    variance += Real(share) * share * (2.0 * s2 * s2 + 4.0 * b2 * s2);
  }
  return {std::sqrt(square), std::sqrt(square + std::sqrt(double(variance))) - std::sqrt(square), -1};
}

NormValue l2_raw(const FrameError& e) {
  const double value = std::sqrt(mean_square(e));
  return {value, e.sigma.empty() ? 0.0 : l2(e).uncertainty, -1};
}

NormValue l1(const FrameError& e) {
  NormValue v{mean_of(e, [&](std::size_t n) { return std::abs(e.error[n]); }), 0.0, -1};
  if (e.sigma.empty()) return v;
  const double W = sum_of(e.weight), bias = std::sqrt(2.0 / std::numbers::pi) *
                                            mean_of(e, [&](std::size_t n) { return e.sigma[n]; });
  Real variance = 0;
  for (std::size_t n = 0; n < e.sigma.size(); ++n)
    variance += Real(e.weight[n] / W) * (e.weight[n] / W) * e.sigma[n] * e.sigma[n];
  v.uncertainty = std::hypot(std::sqrt(double(variance)), bias);
  return v;
}

/// Keeps the sign of a single number, so that a mean or a trend over frames can show it; lengths and many
/// samples are positive.
NormValue linf(const FrameError& e) {
  std::size_t k = 0;
  for (std::size_t n = 1; n < e.error.size(); ++n) k = std::abs(e.error[n]) > std::abs(e.error[k]) ? n : k;
  const bool one = e.error.size() == 1 && e.row[0] < 0;
  NormValue v{one ? e.error[k] : std::abs(e.error[k]), 0.0, e.row[k]};
  if (e.sigma.empty()) return v;
  const double count = std::max<double>(2.0, static_cast<double>(e.sigma.size()));
  v.uncertainty = *std::max_element(e.sigma.begin(), e.sigma.end()) * std::sqrt(2.0 * std::log(count));
  return v;
}

NormValue chi(const FrameError& e) {
  const bool stated =
      !e.sigma.empty() && std::all_of(e.sigma.begin(), e.sigma.end(), [](double s) { return s > 0.0; });
  if (!stated) return {not_a_number, 0.0, -1};
  Real sum = 0;
  for (std::size_t n = 0; n < e.error.size(); ++n)
    sum += Real(e.error[n] / e.sigma[n]) * (e.error[n] / e.sigma[n]);
  const double count = static_cast<double>(e.error.size());
  return {std::sqrt(double(sum) / count), 1.0 / std::sqrt(2.0 * count), -1};
}

}  // namespace

NormValue spatial_norm(Norm norm, const FrameError& e) {
  const bool finite_samples =
      std::all_of(e.error.begin(), e.error.end(), [](double x) { return std::isfinite(x); });
  if (e.error.empty() || !finite_samples || !(sum_of(e.weight) > 0.0)) return {not_a_number, 0.0, -1};
  if (norm == Norm::L1) return l1(e);
  if (norm == Norm::L2) return l2(e);
  if (norm == Norm::L2raw) return l2_raw(e);
  if (norm == Norm::chi) return chi(e);
  return linf(e);
}

}  // namespace tripoint
