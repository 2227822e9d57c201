// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/selftest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/suite.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace {

bool is_ours(const Gate& gate, const std::string& metric) { return gate.metric == metric && (gate.engine.empty() || gate.engine == "tripoint"); }

/// Whether a gate on one of these metrics looks at this run; a gate on every run is content with the case's own.
bool is_needed(const Case& value, const std::vector<std::string>& metrics, const RunPlan& run) {
  for (const auto& metric : metrics)
    for (const auto& gate : value.gates) {
      if (!is_ours(gate, metric) || (!gate.mode.empty() && gate.mode != run.mode)) continue;
      if (metric.ends_with(".order") ? !run.levels.empty() : !gate.level && run.base) return true;
      for (const auto& [axis, level] : run.levels)
        if (gate.level && same_level(level, *gate.level)) return true;
    }
  return false;
}

EngineEntry test_build(const std::string& path) {
  const auto engine = ask_engine(path.empty() ? program_folder() + "/../libexec/tripoint/selftest/engine-tripoint" : path);
  if (!engine.available) throw EngineError("the test build of the solver is not there (build with -DTRIPOINT_TESTS=ON): " + engine.reason);
  return engine;
}

/// Runs what the metrics need, with a defect ("name=size") or without.
CaseResult run_with(const Case& value, const EngineEntry& engine, const std::vector<std::string>& metrics, const std::string& defect, const SelftestOptions& o) {
  SuiteOptions suite;
  suite.selection.engines = {"tripoint"};
  suite.jobs = o.jobs, suite.say = o.say;
  suite.out = (std::filesystem::path(o.out) / (defect.empty() ? "no-defect" : defect)).string();
  if (!defect.empty()) suite.environment["TRIPOINT_DEFECT"] = defect;
  suite.wanted = [&](const EnginePlan&, const RunPlan& run) { return is_needed(value, metrics, run); };
  const auto results = run_suite({value}, {engine}, suite);
  if (results.cases.empty()) throw EngineError("interrupted");
  return results.cases.front();
}

/// Verdicts of one metric of our engine: "pass", "fail at 0.01", ...; empty when nothing was judged.
struct Seen {
  bool any = false, all_green = true, red = false;
  std::string words;
};

Seen look(const CaseResult& result, const std::string& metric) {
  Seen seen;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.gates) {
      if (row.metric != metric || row.verdict == "missing") continue;  // levels that the defect's gates do not need were not run
      seen.any = true;
      seen.all_green = seen.all_green && row.verdict == "pass";
      seen.red = seen.red || row.verdict == "fail" || row.verdict == "diverged";
      seen.words += fmt::format("{}{} {:.3g} {}", seen.words.empty() ? "" : ", ", metric, row.value, row.verdict);
    }
  return seen;
}

DefectOutcome try_defect(const Case& value, const Defect& defect, const EngineEntry& engine, const SelftestOptions& o) {
  DefectOutcome outcome{defect.name, value.id, defect.size, !defect.killed_by.empty(), {}, defect.place};
  const auto whole = run_with(value, engine, defect.killed_by, "", o);
  const auto broken = run_with(value, engine, defect.killed_by, fmt::format("{}={}", defect.name, defect.size), o);
  for (const auto& metric : defect.killed_by) {
    const auto before = look(whole, metric), after = look(broken, metric);
    const bool good = before.any && before.all_green && after.red;
    outcome.killed = outcome.killed && good;
    outcome.found += fmt::format("{}without: {}; with: {}", outcome.found.empty() ? "" : "; ", before.any ? before.words : "no gate on " + metric, after.any ? after.words : "nothing");
  }
  if (defect.killed_by.empty()) outcome.found = "killed_by names no gate";
  return outcome;
}

void check_registry(const std::vector<Case>& cases, const EngineEntry& engine, bool whole, SelftestOutcome& outcome) {
  const auto declared = [&](const std::string& name) {
    return std::any_of(cases.begin(), cases.end(), [&](const Case& c) { return std::any_of(c.defects.begin(), c.defects.end(), [&](const Defect& d) { return d.name == name; }); });
  };
  const auto registered = [&](const std::string& name) { return std::any_of(engine.defects.begin(), engine.defects.end(), [&](const auto& d) { return d.name == name; }); };
  for (const auto& d : engine.defects)
    if (whole && !declared(d.name)) outcome.problems.push_back(fmt::format("{} ({}): no case declares it, {} should", d.name, d.what, d.case_id));
  for (const auto& c : cases)
    for (const auto& d : c.defects)
      if (!registered(d.name)) outcome.problems.push_back(fmt::format("{}: the solver has no defect {}", to_string(d.place), d.name));
}

}  // namespace

SelftestOutcome run_selftest(const SelftestOptions& options) {
  SelftestOutcome outcome;
  const auto engine = test_build(options.engine);
  CaseFilter filter;
  filter.what = options.what;
  const auto cases = select_cases(filter);
  check_registry(cases, engine, options.what.empty(), outcome);
  for (const auto& value : cases)
    for (const auto& defect : value.defects) outcome.defects.push_back(try_defect(value, defect, engine, options));
  for (const auto& value : cases)
    for (auto& row : try_harmless(value, engine, options)) outcome.harmless.push_back(std::move(row));
  const bool survived = std::any_of(outcome.defects.begin(), outcome.defects.end(), [](const auto& d) { return !d.killed; }) ||
                        std::any_of(outcome.harmless.begin(), outcome.harmless.end(), [](const auto& h) { return !h.borne; });
  if (outcome.defects.empty() && outcome.harmless.empty()) outcome.problems.push_back("no case declares a defect or a harmless change: nothing was proven");
  outcome.exit_code = survived || !outcome.problems.empty() ? exit_selftest : exit_pass;
  return outcome;
}

std::string selftest_table(const SelftestOutcome& outcome) {
  std::string text;
  for (const auto& d : outcome.defects)
    text += fmt::format("{:9} {:24} {:<9g} {:26} {}{}\n", d.killed ? "killed" : "SURVIVES", d.defect, d.size, d.case_id, d.found, d.killed ? "" : "  (" + to_string(d.place) + ")");
  for (const auto& p : outcome.problems) text += "PROBLEM   " + p + "\n";
  for (const auto& h : outcome.harmless)
    text += fmt::format("{:9} {:24} {:<9.2g} {:26} {}\n", h.borne ? "borne" : "FELT", h.change, h.greatest, h.case_id, h.found);
  const auto borne = std::count_if(outcome.harmless.begin(), outcome.harmless.end(), [](const auto& h) { return h.borne; });
  const auto killed = std::count_if(outcome.defects.begin(), outcome.defects.end(), [](const auto& d) { return d.killed; });
  return text + fmt::format("{} of {} defects killed, {} of {} harmless changes borne, exit {}\n", killed, outcome.defects.size(), borne, outcome.harmless.size(), outcome.exit_code);
}

}  // namespace tripoint
