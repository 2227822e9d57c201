// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/judge.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

/// Particles are jittered as the study says, or else as in the case's own run.
bool has_jitter_of(const EngineRow& engine, const Study& study, const RunRow& run) {
  if (study.jitter > 0.0) return run.knobs.jitter == study.jitter;
  const auto base =
      std::find_if(engine.runs.begin(), engine.runs.end(), [](const auto& r) { return r.base; });
  return base == engine.runs.end() || run.knobs.jitter == base->knobs.jitter;
}

/// The pooled metric at one level of a study, NaN when any of its runs is missing, not ok, or lacks it.
MetricValue at_level(const EngineRow& engine, const Study& study, JudgedMode mode, const std::string& metric,
                     double level) {
  std::vector<MetricValue> values;
  for (const auto& run : engine.runs) {
    const auto at = run.levels.find(study.axes);
    if (run.knobs.mode != mode || at == run.levels.end() || !same_level(at->second, level) ||
        !has_jitter_of(engine, study, run))
      continue;
    const auto value = measured(run, metric);
    if (run.status != Status::ok || !run.comparable || !value)
      return {not_a_number, {}, "a level has no value", {}, {}};
    values.push_back(*value);
  }
  return values.empty() ? MetricValue{not_a_number, {}, "a level was not run", {}, {}} : pooled(values);
}

std::vector<JudgedMode> modes_of(const EngineRow& engine) {
  std::vector<JudgedMode> modes;
  for (const auto& run : engine.runs)
    if (std::find(modes.begin(), modes.end(), run.knobs.mode) == modes.end()) modes.push_back(run.knobs.mode);
  return modes;
}

/// Metrics to fit: those of the study or all, and the statistical uncertainties that a gate on an order asks
/// for.
std::vector<std::string> metrics_to_fit(const CaseResult& result, const Study& study) {
  std::vector<std::string> names;
  for (const auto& m : result.metrics)
    if (study.metric.empty() || study.metric == m.name) names.push_back(m.name);
  for (const auto& gate : result.gates) {
    if (!is_of_ladder(gate.metric)) continue;
    const std::string name(fitted_metric(gate.metric));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

double numerical_uncertainty(const CaseResult& result, const EngineRow& engine, const RunRow& run,
                             const std::string& metric) {
  static constexpr std::array uncertain{ReferenceKind::experiment, ReferenceKind::self,
                                        ReferenceKind::engine};
  if (std::find(uncertain.begin(), uncertain.end(), result.reference.kind) == uncertain.end()) return 0.0;
  double sum = 0.0;  // space and time add up
  for (const auto& order : engine.order) {
    const auto at = run.levels.find(order.axes);
    if (order.metric != metric || order.mode != run.knobs.mode || at == run.levels.end() ||
        order.numerical.empty())
      continue;
    for (std::size_t k = 0; k < order.step.size(); ++k)
      if (same_level(order.step[k], step_of(order.axes.axis, at->second))) sum += order.numerical[k];
  }
  return sum;
}

double input_uncertainty(const EngineRow& engine, const RunRow& run, const std::string& metric) {
  std::map<std::string, std::vector<double>> ends;
  for (const auto& r : engine.runs) {
    if (r.input.empty() || r.knobs.mode != run.knobs.mode) continue;
    const auto value = measured(r, metric);
    ends[r.input.substr(0, r.input.find('='))].push_back(r.status == Status::ok && value ? value->value
                                                                                         : not_a_number);
  }
  double squares = 0.0;
  for (const auto& [key, values] : ends)
    squares += values.size() == 2 ? 0.25 * (values[1] - values[0]) * (values[1] - values[0]) : not_a_number;
  return std::sqrt(squares);
}

std::vector<OrderRow> fit_orders(const CaseResult& result, const EngineRow& engine, const Study& study) {
  std::vector<OrderRow> rows;
  for (const JudgedMode mode : modes_of(engine)) {
    if (!applies(study, engine.name, mode)) continue;
    for (const auto& metric : metrics_to_fit(result, study)) {
      OrderRow row{metric, study.axes, mode, {}, {}, study.order.value_or(0.0), {}, {}, {}, {}};
      for (const double level : study.levels) {
        const auto value = at_level(engine, study, mode, metric, level);
        row.step.push_back(step_of(study.axes.axis, level));
        row.error.push_back(value.value);
        row.uncertainty.push_back(value.uncertainty.combined());
      }
      if (!std::all_of(row.error.begin(), row.error.end(), [](double e) { return std::isfinite(e); }))
        continue;
      if (row.formal > 0.0 && !metric.ends_with(statistical_part))
        row.numerical = grid_convergence_uncertainties(row.step, row.error, row.formal);
      row.order = fit_order(row.step, row.error, row.uncertainty, row.formal);
      row.limit = ladder_limit(row.step, row.error, row.uncertainty);
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace tripoint
