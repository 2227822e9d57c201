// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/judge/remarks.hpp"
#include "validation/results/results.hpp"

/// Findings of `tripoint gate` about results: the judge's verdict, the case files read again, headroom,
/// baselines. One answer for the command, the summary and the badge.
namespace tripoint {

struct GateVerdict {
  std::vector<Remark> remarks;
  int code = 0;
  std::string word;  ///< PASS, FAIL, LOOSENED ...
  /// Accepted gates that are not judged here, as a tail of the verdict line; empty = none
  std::string absent;
};

/// @param results judged   @param baselines folder that stands for `baselines`; empty = beside the cases
/// @throws InputError where `baselines` is no folder
[[nodiscard]] GateVerdict gate_verdict(const Results&, const std::string& baselines = {},
                                       bool require_baselines = false);

/// Adds remarks of another kind, such as those of a comparison, and forms code and word anew.
void add_remarks(GateVerdict&, const Results&, std::vector<Remark>);

}  // namespace tripoint
