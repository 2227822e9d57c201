// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace tripoint {

struct Case;
struct CaseResult;
struct EngineRow;

/// What an engine's error looks like, for each acceptance limit that it exceeds: the known defect of another
/// engine whose band holds it, and the size of a registered defect of our solver that would make it. Empty
/// where nothing is like it.
/// @param value the case as it was run; nullptr = unknown, and no registered defect is compared
[[nodiscard]] std::string likely_cause(const CaseResult&, const Case* value, const EngineRow&);

}  // namespace tripoint
