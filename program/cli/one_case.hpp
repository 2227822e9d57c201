// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"

/// Commands that run one case: compare and converge.
namespace tripoint {

/// @throws InputError where more than one case is meant
[[nodiscard]] Case one_case(const std::string& what);
/// Runs it, and writes the report. @param paths of engines @throws EngineError where an engine is unknown
[[nodiscard]] Results run_one_case(const Case&, const SuiteOptions&, const std::vector<std::string>& paths);
/// Exit code for the fault that kept the runs from being compared; accuracy is not judged here.
[[nodiscard]] int code_of_runs(const CaseResult&);

}  // namespace tripoint
