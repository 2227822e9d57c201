// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tripoint {
namespace {

using List = std::vector<double>;
constexpr std::size_t least_blocks = 8;

double mean(const List& x, std::size_t from) {
  return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(from), x.end(), 0.0) /
         static_cast<double>(x.size() - from);
}

double squares(const List& x, std::size_t from, double about) {
  double sum = 0.0;
  for (std::size_t i = from; i < x.size(); ++i) sum += (x[i] - about) * (x[i] - about);
  return sum;
}

std::size_t burn_in_of(const List& x) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity(), sum = 0.0, sum_of_squares = 0.0;
  const double about = mean(x, 0);
  for (std::size_t cut = x.size(); cut-- > 0;) {  // from the back: the rest grows by one sample a turn
    sum += x[cut] - about;
    sum_of_squares += (x[cut] - about) * (x[cut] - about);
    const double n = static_cast<double>(x.size() - cut), error = (sum_of_squares - sum * sum / n) / (n * n);
    if (2 * cut <= x.size() && x.size() - cut >= least_blocks && error <= least * (1.0 + 1e-12)) {
      least = error;
      best = cut;
    }
  }
  return best;
}

/// Error of the mean from neighbours averaged in pairs again and again.
List errors_of_blocks(List x) {
  List errors;
  for (; x.size() >= least_blocks; x.resize(x.size() / 2)) {
    const double n = static_cast<double>(x.size());
    errors.push_back(std::sqrt(squares(x, 0, mean(x, 0)) / (n - 1.0) / n));
    for (std::size_t i = 0; 2 * i + 1 < x.size(); ++i) x[i] = 0.5 * (x[2 * i] + x[2 * i + 1]);
  }
  return errors;
}

}  // namespace

StationaryMean stationary_mean(const List& series) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  StationaryMean m;
  if (series.size() < least_blocks ||
      !std::all_of(series.begin(), series.end(), [](double v) { return std::isfinite(v); }))
    return {nan, nan, 0, 0.0, false};
  m.burn_in = burn_in_of(series);
  const List steady(series.begin() + static_cast<std::ptrdiff_t>(m.burn_in), series.end());
  m.value = mean(steady, 0);
  const auto errors = errors_of_blocks(steady);
  m.uncertainty = *std::max_element(errors.begin(), errors.end());
  const double blocks = static_cast<double>(steady.size() >> (errors.size() - 1));
  // An error from n blocks is itself known to 1/sqrt(2(n-1)): a rise within that is no rise.
  m.plateau = errors.size() > 1 &&
              errors.back() <= errors[errors.size() - 2] * (1.0 + 1.0 / std::sqrt(2.0 * (blocks - 1.0)));
  m.effective = m.uncertainty > 0.0
                    ? std::pow(errors.front() / m.uncertainty, 2) * static_cast<double>(steady.size())
                    : static_cast<double>(steady.size());
  return m;
}

}  // namespace tripoint
