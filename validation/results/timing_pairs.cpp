// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/timing_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "validation/case/engine_names.hpp"

namespace tripoint {
namespace {

std::string name_of(const EngineRow& e, const RunRow& r) {
  return label_of(e.name, e.preset) + after_blank(r.knobs.mode);
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return not_a_number;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double median_deviation(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> away;
  for (const double v : values) away.push_back(std::abs(v - middle));
  return median(away);
}

double noise_floor(const std::vector<std::pair<double, double>>& pairs) {
  const double n = static_cast<double>(pairs.size());
  if (pairs.size() < 2) return not_a_number;
  double mean = 0.0, squares = 0.0;
  for (const auto& [a, b] : pairs) mean += std::log(a / b) / n;
  for (const auto& [a, b] : pairs) squares += (std::log(a / b) - mean) * (std::log(a / b) - mean);
  const double floor = std::exp(std::abs(mean) + 2.0 * std::sqrt(squares / (n - 1.0) / n));
  return std::isfinite(floor) ? floor : not_a_number;
}

std::vector<TimingPair> timing_pairs(const CaseResult& result) {
  std::vector<std::pair<std::string, double>> times;
  for (const auto& e : result.engines)
    for (const auto& r : e.runs)
      if (r.base && !r.cost.repeats.empty()) times.emplace_back(name_of(e, r), median(r.cost.repeats));
  std::vector<TimingPair> pairs;
  for (std::size_t a = 0; a < times.size(); ++a)
    for (std::size_t b = a + 1; b < times.size(); ++b) {
      const double ratio = times[a].second / times[b].second;
      pairs.push_back(
          {times[a].first, times[b].first, ratio, std::abs(std::log(ratio)) > std::log(result.timing_floor)});
    }
  return pairs;
}

}  // namespace tripoint
