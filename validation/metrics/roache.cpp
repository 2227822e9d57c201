// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/roache.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace tripoint {
namespace {

constexpr double least_order = 0.05, most_order = 10.0;

/// (h3^p - h2^p)/(h2^p - h1^p) for steps from fine to coarse.
double change_ratio(double h1, double h2, double h3, double p) {
  return (std::pow(h3 / h2, p) - 1.0) / (1.0 - std::pow(h1 / h2, p));
}

/// The order at which errors a h^p change as the values do; NaN where none does.
double observed_order(double h1, double h2, double h3, double ratio) {
  const auto misfit = [&](double p) { return change_ratio(h1, h2, h3, p) - ratio; };
  if (misfit(least_order) * misfit(most_order) > 0.0) return std::numeric_limits<double>::quiet_NaN();
  std::uintmax_t most = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(
      misfit, least_order, most_order, boost::math::tools::eps_tolerance<double>(40), most);
  return 0.5 * (low + high);
}

}  // namespace

RoacheIndex roache_index(const std::vector<double>& step, const std::vector<double>& value) {
  const std::size_t n = step.size();
  if (n < 3 || value.size() != n)
    throw InputError("a grid convergence index needs three levels: name --levels a,b,c");
  if (!std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); }))
    throw InputError("a level has no value: see its reason above");
  const double h1 = step[n - 1], h2 = step[n - 2], h3 = step[n - 3];
  const double f1 = value[n - 1], f2 = value[n - 2], f3 = value[n - 3];
  RoacheIndex r;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double ratio = (f3 - f2) / (f2 - f1);
  r.order = ratio > 0.0 && std::isfinite(ratio) ? observed_order(h1, h2, h3, ratio) : none;
  r.monotone = std::isfinite(r.order);
  if (!r.monotone) {  // no order: three times the largest difference
    r.factor = 3.0;
    r.limit = none;
    r.index = r.factor * std::max(std::abs(f1 - f2), std::abs(f2 - f3));
    return r;
  }
  r.factor = 1.25;
  r.limit = f1 + (f1 - f2) / (std::pow(h2 / h1, r.order) - 1.0);
  r.index = r.factor * std::abs(r.limit - f1);
  return r;
}

}  // namespace tripoint
