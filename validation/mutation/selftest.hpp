// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/mutation/smallest.hpp"
#include "validation/results/results.hpp"
#include "validation/run/discover.hpp"

/// Proof that the gates can fail, and only where they should. Faults in the test build of our solver must
/// turn the gates red that say so. Changes that physics does not feel must leave them green.
namespace tripoint {

struct Case;
struct InvarianceChange;

struct SelftestOptions {
  std::vector<std::string> what;        ///< cases; empty = all
  std::string out = "report/selftest";  ///< folder of the runs
  /// Test build of the engine; empty = libexec/tripoint/selftest/engine-tripoint
  std::string engine;
  int jobs = 1;
  bool only_smallest = false;  ///< only the least visible sizes
  std::function<void(const std::string&)> say;
};

/// One [[defect]] of one case.
struct DefectOutcome {
  std::string defect, case_id;
  double size = 0.0;
  bool killed = false;
  std::string found;  ///< verdicts of the gates
  SourcePlace place;
  bool tried = true;  ///< false where the engine that it is for is not there
};

/// One [[harmless]] of one case.
struct InvarianceOutcome {
  std::string change, case_id;
  bool borne = false;
  double greatest = 0.0;  ///< change of any metric of any mode, in the metric's scaled unit
  double tolerance = 0.0;
  std::string found;  ///< which metric changed most, or what went wrong
};

/// The least size of one defect that a gate of one case sees, whichever its sign.
struct SmallestOutcome {
  /// What: as the term registers it; metric: whose gate turned red first
  std::string defect, what, case_id, metric;
  /// At which it is red; NaN = it is green up to the declared size
  double size = not_a_number;
  double hidden = 0.0;  ///< a size at most 5 % less at which it is green
  double stored = 0.0;  ///< as the case states
  Size verdict = Size::unseen;
  int runs = 0;
  SourcePlace place;
  [[nodiscard]] bool holds() const { return verdict == Size::held || verdict == Size::shrank; }
};

struct SelftestOutcome {
  std::vector<DefectOutcome> defects;
  std::vector<InvarianceOutcome> harmless;
  std::vector<SmallestOutcome> smallest;
  std::vector<std::string> problems;  ///< defects that no case declares, or that the engine does not have
  int exit_code = 0;                  ///< 0 or 5
};

/// Runs each case once without and once with each of its defects. Every metric in killed_by must be green
/// without, and red with it. Also runs it once with each of its invariance tests: every gate must stay green,
/// and no metric may change by more than round-off. Where a defect states a `smallest` size, bisection finds
/// the present one: it may not have grown by more than a quarter.
/// @throws EngineError when the test build is missing
[[nodiscard]] SelftestOutcome run_selftest(const SelftestOptions&);
[[nodiscard]] std::string selftest_table(const SelftestOutcome&);
/// The same as one JSON document, format 1.
[[nodiscard]] std::string selftest_json(const SelftestOutcome&);

/// Lists defects that the terms register and no case declares, or whose own case is gone or does not declare
/// them. Both are asked of the whole suite only. Also lists defects that cases declare and the engine does
/// not have.
[[nodiscard]] std::vector<std::string> registry_problems(const std::vector<Case>&, const EngineEntry&,
                                                         bool whole);

/// Each defect of the case that states a smallest size, bisected.
[[nodiscard]] std::vector<SmallestOutcome> try_smallest(const Case&, const EngineEntry&,
                                                        const SelftestOptions&);

/// The case's own resolution in each of its modes, with and without each invariance test of the case.
[[nodiscard]] std::vector<InvarianceOutcome> try_invariance(const Case&, const EngineEntry&,
                                                            const SelftestOptions&);
/// Effect of a change on the results of a case: both hold the same runs.
[[nodiscard]] InvarianceOutcome judge_invariance(const InvarianceChange&, const CaseResult& without,
                                                 const CaseResult& with);

}  // namespace tripoint
