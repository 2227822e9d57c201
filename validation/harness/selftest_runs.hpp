// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/harness/selftest.hpp"

/// What the self-test does with one case and one defect.
namespace tripoint {

/// Runs what the gates on these metrics need, with a defect ("name=size"; empty = none), into `folder` below the self-test's own.
/// @throws EngineError when interrupted
[[nodiscard]] CaseResult run_with_defect(const Case&, const EngineEntry&, const std::vector<std::string>& metrics, const std::string& defect, const std::string& folder, const SelftestOptions&);

/// Verdicts of one metric of our engine.
struct Seen {
  bool any = false, all_green = true, red = false;
  std::string words;  ///< "pressure 0.012 pass, pressure 0.3 fail"; empty when nothing was judged
};
[[nodiscard]] Seen look(const CaseResult&, const std::string& metric);

}  // namespace tripoint
