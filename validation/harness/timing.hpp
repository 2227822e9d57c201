// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>
#include <vector>

#include "validation/harness/suite.hpp"

/// CPU seconds that can be compared: every run made again in rounds, all after one another, and one run of each engine twice a
/// round. The difference of that engine from itself is the noise floor; a ratio inside it is "not resolved".
namespace tripoint {

/// Adds `rounds` timed runs to every sound run of the case, alone on the machine as far as this program goes. Every second round
/// goes backwards so that a drift cancels. The runs of before were the warm-up; a deterministic engine that ends in other bits is
/// not timed.
void time_case(const Case&, const std::vector<EngineEntry>&, int rounds, const SuiteOptions&, CaseResult&);

/// Factor >= 1 within which the same work was seen to differ from itself: exp of the mean log ratio plus two of its standard
/// errors.
/// @param pairs CPU seconds of the same run, twice a round   @return NaN with fewer than two rounds or a time that is not above 0
[[nodiscard]] double noise_floor(const std::vector<std::pair<double, double>>& pairs);

/// Engines, presets and modes at the case's own resolution against each other, by their medians.
[[nodiscard]] std::vector<TimingPair> timing_pairs(const CaseResult&);

[[nodiscard]] double median(std::vector<double>);
/// Median of the absolute deviations from the median.
[[nodiscard]] double median_deviation(const std::vector<double>&);

}  // namespace tripoint
