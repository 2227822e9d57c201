// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/campaign/invariance.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/mutation/selftest.hpp"

namespace tripoint {
namespace {

void blame(InvarianceOutcome& outcome, const std::string& what) {
  outcome.borne = false;
  outcome.found += (outcome.found.empty() ? "" : "; ") + what;
}

std::string mode_of(const RunRow& run) {
  return run.knobs.mode == JudgedMode::none ? std::string() : std::string(to_string(run.knobs.mode)) + " ";
}

const RunRow* same_run(const EngineRow& engine, const RunRow& run) {
  for (const auto& other : engine.runs)
    if (other.group == run.group && other.knobs.mode == run.knobs.mode) return &other;
  return nullptr;
}

/// Most that any metric of a run changes, and which.
struct Greatest {
  double change = 0.0;
  std::string metric;
};

void compare_metrics(const RunRow& a, const RunRow& b, InvarianceOutcome& outcome, Greatest& most) {
  for (const auto& [name, before] : a.metrics) {
    const auto at = b.metrics.find(name);
    const double after = at == b.metrics.end() ? not_a_number : at->second.value;
    // a metric that this mode does not have
    if (!std::isfinite(before.value) && !std::isfinite(after)) continue;
    const double change = std::abs(after - before.value);
    if (!std::isfinite(change))
      blame(outcome,
            fmt::format("{}{} is {:.3g} without and {:.3g} with", mode_of(a), name, before.value, after));
    else if (most.metric.empty() || change > most.change)
      most = {change, mode_of(a) + name};
  }
}

/// Gates that looked at these runs; those of levels that were not run are missing in both.
void compare_gates(const EngineRow& engine, const char* when, InvarianceOutcome& outcome, int& judged) {
  for (const auto& row : engine.gates) {
    if (row.verdict == Verdict::missing) continue;
    ++judged;
    if (row.verdict != Verdict::pass)
      blame(outcome, fmt::format("{} is {} {} it, at {:.3g}", row.metric, row.verdict, when, row.value));
  }
}

}  // namespace

InvarianceOutcome judge_invariance(const InvarianceChange& change, const CaseResult& without,
                                   const CaseResult& with) {
  InvarianceOutcome outcome{std::string(change.name), without.id, true, 0.0, change.tolerance, {}};
  Greatest most;
  int judged = 0;
  for (const auto& engine : without.engines)
    for (const auto& other : with.engines) {
      if (engine.name != other.name || engine.preset != other.preset) continue;
      for (const auto& run : engine.runs) {
        const auto* changed = same_run(other, run);
        if (run.status != Status::ok || !changed || changed->status != Status::ok)
          blame(outcome, fmt::format("{}run is {} without and {} with{}", mode_of(run), run.status,
                                     changed ? changed->status : Status::missing,
                                     changed ? " " + changed->reason : ""));
        else
          compare_metrics(run, *changed, outcome, most);
        if (changed && change.tolerance == 0.0 && run.state_hash != changed->state_hash)
          blame(outcome, mode_of(run) + "last state has other bits");
      }
      compare_gates(engine, "without", outcome, judged);
      compare_gates(other, "with", outcome, judged);
    }
  if (judged == 0) blame(outcome, "no gate judges the case's own resolution");
  if (most.metric.empty()) blame(outcome, "no metric was formed");
  outcome.greatest = most.change;
  if (most.change > change.tolerance)
    blame(outcome,
          fmt::format("{} changes by {:.3g}, allowed {:.0e}", most.metric, most.change, change.tolerance));
  else if (outcome.borne)
    outcome.found = fmt::format("most: {}, allowed {:.0e}: {}", most.metric, change.tolerance, change.why);
  return outcome;
}

std::vector<InvarianceOutcome> try_invariance(const Case& value, const EngineEntry& engine,
                                              const SelftestOptions& o) {
  const auto run = [&](const InvarianceChange* change) {
    SuiteOptions suite;
    suite.selection.engines = {engine_name::solver};
    suite.environment["OMP_WAIT_POLICY"] = "passive";  // two threads on a busy core would spin for each other
    suite.jobs = o.jobs;
    suite.say = o.say;
    suite.change = change;
    suite.out =
        (std::filesystem::path(o.out) / (change ? "harmless-" + std::string(change->name) : "no-change"))
            .string();
    suite.wanted = [](const EnginePlan&, const RunPlan& plan) { return plan.base; };
    auto results = run_suite({value}, {engine}, suite);
    if (results.cases.empty()) throw EngineError("interrupted");
    return std::move(results.cases.front());
  };
  std::vector<InvarianceOutcome> rows;
  std::optional<CaseResult> without;
  for (const auto& name : value.harmless) {
    const auto& change = invariance_change(name);
    if (const auto why = change.refusal(value.scene); !why.empty()) {
      rows.push_back(
          {name, value.id, false, not_a_number, change.tolerance, "it is no symmetry of this scene: " + why});
      continue;
    }
    if (!without) without = run(nullptr);
    rows.push_back(judge_invariance(change, *without, run(&change)));
  }
  return rows;
}

}  // namespace tripoint
