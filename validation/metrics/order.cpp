// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/power_law.hpp"

namespace tripoint {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double roundoff = 1e-12;  // of a scaled error: sums of 1e4 terms at 1e-16

using List = std::vector<double>;

/// Slope between neighbouring levels; negative where refinement makes it worse.
List local_slopes(const List& h, const List& e) {
  List slopes;
  for (std::size_t i = 1; i < h.size(); ++i)
    slopes.push_back(std::log(std::abs(e[i - 1] / e[i])) / std::log(h[i - 1] / h[i]));
  return slopes;
}

bool changes_sign(const List& e) {
  return std::any_of(e.begin(), e.end(), [](double x) { return x > 0.0; }) &&
         std::any_of(e.begin(), e.end(), [](double x) { return x < 0.0; });
}

bool monotone(const List& e) {
  bool falls = true, rises = true;
  for (std::size_t i = 1; i < e.size(); ++i) {
    falls = falls && std::abs(e[i]) <= std::abs(e[i - 1]);
    rises = rises && std::abs(e[i]) >= std::abs(e[i - 1]);
  }
  return falls || rises;
}

/// The two finest errors are within two standard uncertainties: finer levels say nothing about the scheme.
bool lost_in_noise(const List& e, const List& u) {
  if (u.size() != e.size() || e.size() < 2) return false;
  const auto hidden = [&](std::size_t i) { return std::abs(e[i]) < 2.0 * u[i]; };
  return hidden(e.size() - 1) && hidden(e.size() - 2);
}

/// GCI_23/(r^p GCI_12) from the last three levels; near 1 in the asymptotic range [Roache 1994].
double gci_ratio(const List& h, const List& e, double p) {
  const std::size_t n = e.size();
  const double fine = (e[n - 2] - e[n - 1]) / (std::pow(h[n - 2] / h[n - 1], p) - 1.0);
  const double coarse = (e[n - 3] - e[n - 2]) / (std::pow(h[n - 3] / h[n - 2], p) - 1.0);
  return coarse / (std::pow(h[n - 2] / h[n - 1], p) * fine);
}

bool asymptotic(const Order& fit, const List& h, const List& e, double formal) {
  const auto slopes = local_slopes(h, e);
  const bool settled = std::abs(slopes.back() - slopes[slopes.size() - 2]) <= 0.3;
  const bool steady = std::abs(gci_ratio(h, e, fit.value) - 1.0) <= 0.1;
  if (formal <= 0.0) return settled && steady && fit.low > 0.0;
  const bool meets = fit.high >= formal - 0.3 && fit.low <= formal + 0.5;
  return settled && steady && meets && !(fit.low <= formal - 1.0 && formal - 1.0 <= fit.high);
}

/// The floored law is taken when it explains the data better. Its floor must not be zero at 95 % and must
/// make up a quarter of the finest error.
bool has_floor(const FlooredPowerLaw& floored, const PowerLaw& plain, const List& e) {
  if (!floored.found || floored.floor.low * floored.floor.high <= 0.0) return false;
  if (std::abs(floored.floor.value) < 0.25 * std::abs(e.back())) return false;
  return changes_sign(e) || akaike(floored.residual, e.size(), 3) < akaike(plain.residual, e.size(), 2);
}

Order sized(FitClass name, double p, double low, double high, double coefficient, double floor = 0.0) {
  Order order;
  order.value = p;
  order.low = low;
  order.high = high;
  order.fit_class = name;
  order.coefficient = coefficient;
  order.floor = floor;
  return order;
}

}  // namespace

Order fit_order(const List& step, const List& error, const List& uncertainty, double formal) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (step.size() != error.size() || step.size() < 2) return sized(FitClass::too_few, nan, nan, nan, nan);
  if (!std::all_of(error.begin(), error.end(), finite)) return sized(FitClass::diverging, nan, nan, nan, nan);
  if (std::all_of(error.begin(), error.end(), [](double e) { return std::abs(e) <= roundoff; }))
    return sized(FitClass::roundoff, nan, nan, nan, 0.0);
  if (std::any_of(error.begin(), error.end(), [](double e) { return e == 0.0; }))
    return sized(FitClass::oscillating, nan, nan, nan, nan);

  const auto plain = fit_power_law(step, error);
  const auto with = [&](FitClass name) {
    return sized(name, plain.order.value, plain.order.low, plain.order.high, plain.coefficient);
  };
  if (step.size() < 4) return with(FitClass::too_few);
  if (std::abs(error.back()) <= roundoff) return with(FitClass::roundoff);
  if (lost_in_noise(error, uncertainty)) return with(FitClass::noise_limited);
  const auto floored = fit_floored_power_law(step, error);
  if (has_floor(floored, plain, error))
    return sized(FitClass::plateau, floored.order.value, floored.order.low, floored.order.high,
                 floored.coefficient, floored.floor.value);
  if (plain.order.high < 0.0 || (plain.order.value < 0.0 && monotone(error)))
    return with(FitClass::diverging);
  if (changes_sign(error) || !monotone(error)) return with(FitClass::oscillating);
  const Order fit = with(FitClass::asymptotic);
  return asymptotic(fit, step, error, formal) ? fit : with(FitClass::preasymptotic);
}

}  // namespace tripoint
