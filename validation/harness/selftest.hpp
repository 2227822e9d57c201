// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

/// Proof that the gates can fail: faults are put into the test build of our solver, and must turn the gates red that say so.
namespace tripoint {

struct SelftestOptions {
  std::vector<std::string> what;        ///< cases; empty = all
  std::string out = "report/selftest";  ///< folder of the runs
  std::string engine;                   ///< test build of the engine; empty = libexec/tripoint/selftest/engine-tripoint
  int jobs = 1;
  std::function<void(const std::string&)> say;
};

/// One [[defect]] of one case.
struct DefectOutcome {
  std::string defect, case_id;
  double size = 0.0;
  bool killed = false;
  std::string found;  ///< what the gates said
  SourcePlace place;
};

struct SelftestOutcome {
  std::vector<DefectOutcome> defects;
  std::vector<std::string> problems;  ///< defects that no case declares, or that the engine does not have
  int exit_code = 0;                  ///< 0 or 5
};

/// Runs each case once without and once with each of its defects: every metric in killed_by must be green without, and red with it.
/// @throws EngineError when the test build is missing
[[nodiscard]] SelftestOutcome run_selftest(const SelftestOptions&);
[[nodiscard]] std::string selftest_table(const SelftestOutcome&);

}  // namespace tripoint
