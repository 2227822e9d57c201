// SPDX-License-Identifier: BSD-3-Clause
#include "validation/mutation/selftest_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

bool judges(const Gate& gate, const std::string& engine, const std::string& metric) {
  return gate.metric == metric && (gate.engine.empty() || gate.engine == engine);
}

/// Whether a gate on one of these metrics looks at this run; a gate on every run is content with the case's
/// own.
bool is_needed(const Case& value, const std::string& engine, const std::vector<std::string>& metrics,
               const RunPlan& run) {
  for (const auto& metric : metrics)
    for (const auto& gate : value.gates) {
      if (!judges(gate, engine, metric) || !fits_mode(gate, run.mode)) continue;
      if (is_of_ladder(metric) ? !run.levels.empty() : !gate.level && run.base) return true;
      for (const auto& [axes, level] : run.levels)
        if (gate.level && same_level(level, *gate.level)) return true;
    }
  return false;
}

}  // namespace

std::string engine_of_defect(const Case& value, const Defect& defect) {
  const auto judged_by = [&](const std::string& engine) {
    return std::any_of(value.gates.begin(), value.gates.end(), [&](const Gate& g) {
      return std::find(defect.killed_by.begin(), defect.killed_by.end(), g.metric) !=
                 defect.killed_by.end() &&
             g.engine == engine;
    });
  };
  using namespace engine_name;
  return !judged_by(solver) && !judged_by("") && judged_by(solver_on_ranks) ? solver_on_ranks : solver;
}

CaseResult run_with_defect(const Case& value, const EngineEntry& engine,
                           const std::vector<std::string>& metrics, const std::string& defect,
                           const std::string& folder, const SelftestOptions& o) {
  SuiteOptions suite;
  suite.selection.engines = {engine.name};
  suite.jobs = o.jobs;
  suite.say = o.say;
  suite.out = (std::filesystem::path(o.out) / folder).string();
  if (!defect.empty()) suite.environment["TRIPOINT_DEFECT"] = defect;
  suite.wanted = [&](const EnginePlan&, const RunPlan& run) {
    return is_needed(value, engine.name, metrics, run);
  };
  const auto results = run_suite({value}, {engine}, suite);
  if (results.cases.empty()) throw EngineError("interrupted");
  return results.cases.front();
}

std::vector<JudgedMode> judged_modes(const CaseResult& result, const std::string& metric) {
  std::vector<JudgedMode> modes;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.gates)
      if (row.metric == metric && row.verdict != Verdict::missing &&
          std::find(modes.begin(), modes.end(), row.mode) == modes.end())
        modes.push_back(row.mode);
  return modes;
}

JudgedMode decisive_mode(const CaseResult& result, const std::string& metric, const std::string& defect) {
  const auto modes = judged_modes(result, metric);
  const JudgedMode wanted =
      defect.find(".paper.") != std::string::npos ? JudgedMode::paper : JudgedMode::corrected;
  if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) return wanted;
  return modes.empty() ? JudgedMode::none : modes.front();
}

Seen look(const CaseResult& result, const std::string& metric, JudgedMode mode) {
  Seen seen;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.gates) {
      if (row.metric != metric || row.mode != mode || row.verdict == Verdict::missing)
        continue;  // levels that the defect's gates do not need were not run
      seen.any = true;
      seen.all_green = seen.all_green && row.verdict == Verdict::pass;
      seen.red = seen.red || row.verdict == Verdict::fail || row.verdict == Verdict::diverged;
      seen.words +=
          fmt::format("{}{} {:.3g} {}", seen.words.empty() ? "" : ", ", metric, row.value, row.verdict);
    }
  return seen;
}

}  // namespace tripoint
