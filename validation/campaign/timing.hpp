// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>
#include <vector>

#include "validation/campaign/suite.hpp"

/// CPU seconds that can be compared: every run made again in rounds, all after one another, and one run of
/// each engine twice a round. The difference of that engine from itself is the noise floor; a ratio inside it
/// is "not resolved".
namespace tripoint {

/// Adds `rounds` timed runs to every sound run of the case, alone on the machine as far as this program goes.
/// Every second round goes backwards so that a drift cancels. The runs of before were the warm-up; a
/// deterministic engine that ends in other bits is not timed.
void time_case(const Case&, const std::vector<EngineEntry>&, int rounds, const SuiteOptions&, CaseResult&);

}  // namespace tripoint
