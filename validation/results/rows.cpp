// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/rows.hpp"

#include <algorithm>
#include <cmath>

#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"

namespace tripoint {

bool same_level(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

bool applies(const Study& study, const std::string& engine, JudgedMode mode) {
  if (is_exact(engine)) return false;  // truth does not converge
  return (study.engine.empty() || study.engine == engine) && fits(study.mode, mode);
}

std::optional<MetricValue> measured(const RunRow& run, const std::string& metric) {
  if (const auto at = run.metrics.find(metric); at != run.metrics.end()) return at->second;
  if (!metric.ends_with(statistical_part)) return {};
  const auto at = run.metrics.find(metric.substr(0, metric.size() - statistical_part.size()));
  if (at == run.metrics.end()) return {};
  // An unknown scatter is no scatter of 0
  const bool known = std::isfinite(at->second.value) && at->second.uncertainty.statistical > 0.0;
  return MetricValue{known ? at->second.uncertainty.statistical : not_a_number,
                     {},
                     "statistical standard uncertainty",
                     {},
                     {}};
}

MetricValue pooled(const std::vector<MetricValue>& values) {
  if (values.size() == 1) return values.front();
  MetricValue pool = values.front();
  const double n = static_cast<double>(values.size());
  double sum = 0.0, stated = 0.0, scatter = 0.0;
  for (const auto& v : values) {
    sum += v.value;
    stated += v.uncertainty.statistical * v.uncertainty.statistical;
    pool.uncertainty.numerical = std::max(pool.uncertainty.numerical, v.uncertainty.numerical);
    pool.uncertainty.input = std::max(pool.uncertainty.input, v.uncertainty.input);
    pool.uncertainty.data = std::max(pool.uncertainty.data, v.uncertainty.data);
  }
  pool.value = sum / n;
  for (const auto& v : values) scatter += (v.value - pool.value) * (v.value - pool.value);
  pool.uncertainty.statistical = std::max(std::sqrt(stated) / n, std::sqrt(scatter / (n - 1.0) / n));
  return pool;
}

bool crashed(const RunRow& run) {
  return run.status != Status::ok && run.status != Status::refused && run.status != Status::missing &&
         run.status != Status::diverged;
}

bool is_unjudged(const EngineRow& engine) {
  return !is_exact(engine.name) && engine.status == Status::ok && engine.gates.empty();
}

bool may_diverge(const CaseResult& result, JudgedMode mode) {
  return result.expect == Expect::diverges ||
         (result.expect == Expect::paper_diverges && mode == JudgedMode::paper);
}

}  // namespace tripoint
