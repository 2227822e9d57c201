// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

/// Another engine's trajectory in the place of the truth: the metrics then measure the difference of the two.
class OtherEngine : public Reference {
 public:
  explicit OtherEngine(const Trajectory& trajectory) : trajectory_(trajectory) {}
  /// The frame nearest in time: both engines hold every time of the job to 1e-9 of its end, by audit.
  [[nodiscard]] Snapshot at(double time) const override {
    const auto nearer = [&](const Snapshot& a, const Snapshot& b) {
      return std::abs(a.time - time) < std::abs(b.time - time);
    };
    return *std::min_element(trajectory_.frames.begin(), trajectory_.frames.end(), nearer);
  }

 private:
  const Trajectory& trajectory_;
};

/// Margin of the case for a metric: the greatest limit that a gate sets on it without a level of its own.
std::optional<double> margin_of(const Case& value, const std::string& metric) {
  std::optional<double> margin;
  for (const auto& gate : value.gates)
    if (gate.metric == metric && gate.limit && !gate.level)
      margin = std::max(margin.value_or(0.0), *gate.limit);
  return margin;
}

bool compares_states(const MetricChoice& metric) { return metric.quantity.rfind("ledger", 0) != 0; }

void compare_pair(const CaseRuns& all, const CaseRun& a, const CaseRun& b,
                  std::vector<EquivalenceRow>& rows) {
  const OtherEngine other(*b.trajectory);
  for (const auto& metric : all.value->metrics) {
    const auto error_a = a.row.metrics.find(metric.name), error_b = b.row.metrics.find(metric.name);
    if (!compares_states(metric) || error_a == a.row.metrics.end() || error_b == b.row.metrics.end())
      continue;
    MetricValue difference;
    try {
      difference = evaluate(metric, a.job, *a.initial, *a.trajectory, other);
    } catch (const std::exception&) {
      continue;  // a metric of numbers that only a formula knows (rates, event times) compares no two states
    }
    if (!std::isfinite(difference.value)) continue;
    EquivalenceRow row{
        label_of(all.engines[a.engine].name, all.engines[a.engine].preset),
        label_of(all.engines[b.engine].name, all.engines[b.engine].preset),
        metric.name,
        difference.value,
        std::hypot(error_a->second.uncertainty.combined(), error_b->second.uncertainty.combined()),
        margin_of(*all.value, metric.name),
        error_a->second.value,
        error_b->second.value,
        Equivalence::no_margin};
    if (row.margin) row.verdict = equivalence(row.difference, row.uncertainty, *row.margin);
    rows.push_back(row);
  }
}

}  // namespace

std::vector<EquivalenceRow> compare_engines(const CaseRuns& all) {
  std::vector<const CaseRun*> bases;  // one for each engine and preset; of tripoint the first mode
  for (const auto& run : all.runs) {
    const bool first =
        std::none_of(bases.begin(), bases.end(), [&](const auto* b) { return b->engine == run.engine; });
    if (run.plan.base && run.trajectory && run.row.comparable && first &&
        !is_exact(all.engines[run.engine].name))
      bases.push_back(&run);
  }
  std::vector<EquivalenceRow> rows;
  for (std::size_t i = 0; i < bases.size(); ++i)
    for (std::size_t j = i + 1; j < bases.size(); ++j) compare_pair(all, *bases[i], *bases[j], rows);
  return rows;
}

std::map<std::string, double> ledger_of(const Trajectory& trajectory) {
  std::map<std::string, double> change;
  if (trajectory.frames.empty()) return change;
  const auto& first = trajectory.frames.front().energy;
  double residual = 0.0;
  for (const auto& [term, energy] : trajectory.frames.back().energy) {
    const auto at = first.find(term);
    change[term] = energy - (at == first.end() ? 0.0 : at->second);
    residual += change[term];
  }
  if (!change.empty()) change["residual"] = residual;
  return change;
}

}  // namespace tripoint
