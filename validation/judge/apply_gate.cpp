// SPDX-License-Identifier: BSD-3-Clause
#include "validation/judge/apply_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/judge.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

bool is_at_level(const RunRow& run, const std::optional<double>& level) {
  return !level || std::any_of(run.levels.begin(), run.levels.end(),
                               [&](const auto& l) { return same_level(l.second, *level); });
}

/// Runs that differ by seed only, in the order in which they were planned.
struct Group {
  JudgedMode mode = JudgedMode::none;
  std::map<StudyAxes, double> levels;
  std::vector<const RunRow*> runs;
};

std::vector<Group> groups_for(const Gate& gate, const EngineRow& engine) {
  std::vector<Group> groups;
  for (const auto& run : engine.runs) {
    if (!run.input.empty() || !fits_mode(gate, run.knobs.mode) || !is_at_level(run, gate.level)) continue;
    const auto same = [&](const Group& g) {
      return !run.group.empty() && g.mode == run.knobs.mode && g.runs.front()->group == run.group;
    };
    const auto at = std::find_if(groups.begin(), groups.end(), same);
    if (at == groups.end())
      groups.push_back({run.knobs.mode, run.levels, {&run}});
    else
      at->runs.push_back(&run);
  }
  return groups;
}

GateRow new_row(const Gate& gate, JudgedMode mode) {
  GateRow row;
  row.metric = gate.metric;
  row.mode = mode;
  row.level = gate.level;
  row.gate = gate;
  if (!gate.limit && !gate.at_least && !gate.band) row.expect = gate.expect;  // it judges the class alone
  row.value = not_a_number;
  return row;
}

GateRow missing_row(const Gate& gate, const std::string& why) {
  auto row = new_row(gate, gate.mode);
  row.verdict = Verdict::missing;
  row.why = why;
  return row;
}

void judge_value(GateRow& row, const MetricValue& metric) {
  row.value = metric.value;
  row.budget = metric.uncertainty;
  row.uncertainty = metric.uncertainty.combined();
  const auto verdict = verdict_of(row.gate, row.value, row.uncertainty);
  row.verdict = verdict;
  if (verdict == Verdict::pass) return;
  if (!std::isfinite(row.value))
    row.why = "not finite" + (metric.note.empty() ? std::string() : ": " + metric.note);
  else
    row.why = fmt::format("{:.4g} with standard uncertainty {:.2g}, {}", row.value, row.uncertainty,
                          describe(row.gate));
}

/// An engine may refuse a run, but not one seed of it: nobody would judge the results of the other seeds.
bool any_ok(const Group& group) {
  return std::any_of(group.runs.begin(), group.runs.end(),
                     [](const auto* run) { return run->status == Status::ok; });
}

/// @return false when the group gives no row: its run failed, and the engine's row says so
bool judge_group(const CaseResult& result, const Gate& gate, const Group& group, EngineRow& engine) {
  auto row = new_row(gate, group.mode);
  if (!row.level && group.levels.size() == 1) row.level = group.levels.begin()->second;
  std::vector<MetricValue> values;
  for (const auto* run : group.runs) {
    if (run->status != Status::ok || !run->comparable) {
      if (!engine.required && !any_ok(group) && run->comparable && run->status != Status::diverged &&
          !crashed(*run))
        return false;
      row.verdict = run->status == Status::diverged ? Verdict::diverged : Verdict::missing;
      row.why = run->reason.empty() ? std::string(to_string(run->status)) : run->reason;
      engine.gates.push_back(row);
      return true;
    }
    auto value = measured(*run, gate.metric);
    if (!value) {
      row.verdict = Verdict::missing;
      row.why = "the run has no metric of this name";
      engine.gates.push_back(row);
      return true;
    }
    value->uncertainty.numerical =
        std::max(value->uncertainty.numerical, numerical_uncertainty(result, engine, *run, gate.metric));
    value->uncertainty.input =
        std::max(value->uncertainty.input, input_uncertainty(engine, *run, gate.metric));
    values.push_back(*value);
  }
  judge_value(row, pooled(values));
  engine.gates.push_back(row);
  return true;
}

bool has_mode(const EngineRow& engine, const Gate& gate) {
  return gate.mode == JudgedMode::none ||
         std::any_of(engine.runs.begin(), engine.runs.end(),
                     [&](const auto& r) { return fits_mode(gate, r.knobs.mode); });
}

/// Runs that the engine refused, and none that it broke off: then it owes no order.
bool declined(const EngineRow& engine) {
  if (std::any_of(engine.runs.begin(), engine.runs.end(), [](const auto& r) { return crashed(r); }))
    return false;
  return std::any_of(engine.runs.begin(), engine.runs.end(),
                     [](const auto& r) { return r.status != Status::ok || !r.comparable; });
}

/// Whether a study of the case makes this engine run at the gate's level (any level, if it names none).
bool level_is_due(const CaseResult& result, const Gate& gate, const EngineRow& engine) {
  return std::any_of(result.studies.begin(), result.studies.end(), [&](const Study& s) {
    if (is_exact(engine.name) || (!s.engine.empty() && s.engine != engine.name)) return false;
    if (s.mode != JudgedMode::none && !fits_mode(gate, s.mode)) return false;
    return !gate.level || std::any_of(s.levels.begin(), s.levels.end(),
                                      [&](double l) { return same_level(l, *gate.level); });
  });
}

/// Whether the finest error is at most a thousandth of where any engine's ladder may end.
bool has_arrived(const CaseResult& result, const OrderRow& ladder) {
  return std::any_of(result.gates.begin(), result.gates.end(), [&](const Gate& g) {
    return g.engine.empty() && g.limit && is_of_ladder(g.metric) && !is_order(g.metric) &&
           fitted_metric(g.metric) == ladder.metric && std::abs(ladder.error.back()) <= 1e-3 * *g.limit;
  });
}

/// An engine that is exact has no order to show: where any engine is asked for one at least, errors of
/// round-off will do, in single precision too.
bool needs_no_order(const CaseResult& result, const Gate& gate, const OrderRow& ladder) {
  return gate.engine.empty() && gate.at_least && !gate.band && !gate.limit &&
         (ladder.order.fit_class == FitClass::roundoff || has_arrived(result, ladder));
}

void judge_order(const CaseResult& result, GateRow& row, const OrderRow& ladder) {
  const Order& order = ladder.order;
  row.value = order.value;
  row.low = order.low;
  row.high = order.high;
  row.fit_class = order.fit_class;
  row.verdict = needs_no_order(result, row.gate, ladder) ? Verdict::pass : verdict_of(row.gate, order);
  if (row.verdict == Verdict::pass) return;
  row.why = fmt::format("order {:.3g}, 95 % interval {:.3g} to {:.3g}, {}, {}", row.value, *row.low,
                        *row.high, *row.fit_class, describe(row.gate));
  if (order.fit_class == FitClass::plateau && !row.gate.expect)
    row.why += fmt::format("; the error does not fall to the truth: it ends at {:.3g}", order.floor);
}

/// The error that the ladder leaves at step 0: its size, and how well the levels know it.
void judge_limit_of_ladder(GateRow& row, const LadderLimit& limit) {
  MetricValue value;
  value.value = std::abs(limit.value);
  value.uncertainty.numerical = limit.uncertainty;
  judge_value(row, value);
  if (row.verdict != Verdict::pass) row.why = "extrapolated to step 0: " + row.why;
}

Applied judge_ladder(const CaseResult& result, const Gate& gate, EngineRow& engine) {
  bool judged = false;
  for (const auto& ladder : engine.order) {
    if (ladder.metric != fitted_metric(gate.metric) || !fits_mode(gate, ladder.mode)) continue;
    auto row = new_row(gate, ladder.mode);
    if (is_order(gate.metric))
      judge_order(result, row, ladder);
    else
      judge_limit_of_ladder(row, ladder.limit);
    engine.gates.push_back(row);
    judged = true;
  }
  if (judged) return Applied::judged;
  if (!level_is_due(result, gate, engine)) return Applied::not_applicable;
  if (declined(engine) && !engine.required) return Applied::absent;
  engine.gates.push_back(missing_row(gate, "nothing could be fitted: a level is missing or not finite"));
  return Applied::judged;
}

}  // namespace

bool fits_mode(const Gate& gate, JudgedMode mode) { return fits(gate.mode, mode); }

Applied apply_gate(const CaseResult& result, const Gate& gate, EngineRow& engine) {
  if (engine.runs.empty()) return Applied::absent;
  if (!has_mode(engine, gate)) return Applied::not_applicable;
  if (is_of_ladder(gate.metric)) return judge_ladder(result, gate, engine);
  const auto groups = groups_for(gate, engine);
  if (groups.empty()) {
    if (!level_is_due(result, gate, engine)) return Applied::not_applicable;
    engine.gates.push_back(missing_row(gate, "the level of this gate was not run"));
    return Applied::judged;
  }
  bool judged = false;
  for (const auto& group : groups) judged = judge_group(result, gate, group, engine) || judged;
  return judged ? Applied::judged : Applied::absent;
}

Applied apply_expected_class(const CaseResult& result, const Study& study, EngineRow& engine) {
  const std::string metric = !study.metric.empty()    ? study.metric
                             : result.metrics.empty() ? std::string()
                                                      : result.metrics.front().name;
  Gate gate;
  gate.metric = metric + ".order";
  gate.engine = engine.name;
  gate.mode = study.mode;
  gate.place = study.place;
  gate.reason = fmt::format("the study over {} declares the class {}", to_string(study.axes), *study.expect);
  auto applied = Applied::not_applicable;
  for (const auto& order : fit_orders(result, engine, study)) {
    if (order.metric != metric) continue;
    auto row = new_row(gate, order.mode);
    row.value = order.order.value;
    row.low = order.order.low;
    row.high = order.order.high;
    row.expect = study.expect;
    row.fit_class = order.order.fit_class;
    row.verdict = row.fit_class == study.expect ? Verdict::pass : Verdict::fail;
    if (row.fit_class != study.expect)
      row.why = fmt::format("converges as {}, declared is {}", *row.fit_class, *study.expect);
    engine.gates.push_back(row);
    applied = Applied::judged;
  }
  if (applied == Applied::judged || engine.runs.empty() ||
      !(study.engine.empty() || study.engine == engine.name))
    return applied;
  if (is_exact(engine.name) || !has_mode(engine, gate) || (declined(engine) && !engine.required))
    return Applied::absent;
  auto row = missing_row(gate, "no order could be fitted: a level is missing or not finite");
  row.expect = study.expect;
  engine.gates.push_back(row);
  return Applied::judged;
}

}  // namespace tripoint
