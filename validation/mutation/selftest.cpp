// SPDX-License-Identifier: BSD-3-Clause
#include "validation/mutation/selftest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/mutation/selftest_runs.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

EngineEntry test_build(const std::string& path) {
  const auto engine =
      ask_engine(path.empty() ? program_folder() + "/../libexec/tripoint/selftest/engine-tripoint" : path);
  if (!engine.available)
    throw EngineError(
        "the self-test needs the solver's test build, which holds the defects, and it is not built. In the "
        "checkout type:  "
        "tools/build.sh --selftest 2");
  return engine;
}

/// Beside the solver, where they are there: the optional test build of it over ranks.
std::vector<EngineEntry> test_builds(const EngineEntry& solver) {
  std::vector<EngineEntry> engines{solver};
  const std::string ranks =
      (std::filesystem::path(solver.executable).parent_path() / "engine-tripoint-mpi").string();
  if (std::error_code none; std::filesystem::exists(ranks, none)) engines.push_back(ask_engine(ranks));
  return engines;
}

DefectOutcome try_defect(const Case& value, const Defect& defect, const std::vector<EngineEntry>& engines,
                         const SelftestOptions& o) {
  DefectOutcome outcome{defect.name, value.id, defect.size, !defect.killed_by.empty(), {}, defect.place};
  const auto name = engine_of_defect(value, defect);
  const auto found = std::find_if(engines.begin(), engines.end(),
                                  [&](const EngineEntry& e) { return e.name == name && e.available; });
  if (found == engines.end()) {
    outcome.tried = outcome.killed = false;
    outcome.found = name + " is not there: its wheel, or its test build";
    return outcome;
  }
  const EngineEntry& engine = *found;
  const auto whole = run_with_defect(value, engine, defect.killed_by, "", "no-defect", o);
  const auto text = fmt::format("{}={}", defect.name, defect.size);
  const auto broken = run_with_defect(value, engine, defect.killed_by, text, text, o);
  for (const auto& metric : defect.killed_by) {
    const auto mode = decisive_mode(whole, metric, defect.name);
    const auto before = look(whole, metric, mode), after = look(broken, metric, mode);
    const bool good = before.any && before.all_green && after.red;
    outcome.killed = outcome.killed && good;
    outcome.found +=
        fmt::format("{}without: {}; with: {}", outcome.found.empty() ? "" : "; ",
                    before.any ? before.words : "no gate on " + metric, after.any ? after.words : "nothing");
  }
  if (defect.killed_by.empty()) outcome.found = "killed_by names no gate";
  return outcome;
}

void try_all(const std::vector<Case>& cases, const EngineEntry& solver, const SelftestOptions& options,
             SelftestOutcome& outcome) {
  const auto engines = test_builds(solver);
  for (const auto& value : cases)
    for (const auto& defect : value.defects)
      outcome.defects.push_back(try_defect(value, defect, engines, options));
  for (const auto& value : cases)
    for (auto& row : try_invariance(value, solver, options)) outcome.harmless.push_back(std::move(row));
}

}  // namespace

std::vector<std::string> registry_problems(const std::vector<Case>& cases, const EngineEntry& engine,
                                           bool whole) {
  std::vector<std::string> problems;
  const auto declared = [&](const std::string& name) {
    return std::any_of(cases.begin(), cases.end(), [&](const Case& c) {
      return std::any_of(c.defects.begin(), c.defects.end(), [&](const Defect& d) { return d.name == name; });
    });
  };
  const auto registered = [&](const std::string& name) {
    return std::any_of(engine.defects.begin(), engine.defects.end(),
                       [&](const auto& d) { return d.name == name; });
  };
  const auto declared_by = [&](const std::string& id, const std::string& name) {
    const auto at = std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.id == id; });
    return at != cases.end() && std::any_of(at->defects.begin(), at->defects.end(),
                                            [&](const Defect& d) { return d.name == name; });
  };
  for (const auto& d : engine.defects) {
    if (!whole) continue;
    if (!declared(d.name))
      problems.push_back(fmt::format("{} ({}): no case declares it, {} should", d.name, d.what, d.case_id));
    else if (!declared_by(d.case_id, d.name))
      problems.push_back(fmt::format(
          "{} ({}): the term names {} as the case that kills it, which is not there or does not declare it",
          d.name, d.what, d.case_id));
  }
  for (const auto& c : cases)
    for (const auto& d : c.defects)
      if (!registered(d.name))
        problems.push_back(fmt::format("{}: the solver has no defect {}", to_string(d.place), d.name));
  return problems;
}

SelftestOutcome run_selftest(const SelftestOptions& options) {
  SelftestOutcome outcome;
  const auto engine = test_build(options.engine);
  CaseFilter filter;
  filter.what = options.what;
  const auto cases = select_cases(filter);
  outcome.problems = registry_problems(cases, engine, options.what.empty());
  for (const auto& value : cases)
    for (auto& row : try_smallest(value, engine, options)) outcome.smallest.push_back(std::move(row));
  if (!options.only_smallest) try_all(cases, engine, options, outcome);
  const bool survived =
      std::any_of(outcome.defects.begin(), outcome.defects.end(),
                  [](const auto& d) { return d.tried && !d.killed; }) ||
      std::any_of(outcome.harmless.begin(), outcome.harmless.end(), [](const auto& h) { return !h.borne; }) ||
      std::any_of(outcome.smallest.begin(), outcome.smallest.end(), [](const auto& s) { return !s.holds(); });
  if (outcome.defects.empty() && outcome.harmless.empty() && outcome.smallest.empty())
    outcome.problems.push_back(options.only_smallest
                                   ? "no case states the smallest size of a defect: nothing was sought"
                                   : "no case declares a defect or an invariance test: nothing was proven");
  outcome.exit_code = survived || !outcome.problems.empty() ? exit_selftest : exit_pass;
  return outcome;
}

}  // namespace tripoint
