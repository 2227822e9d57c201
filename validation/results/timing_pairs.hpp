// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "validation/results/results.hpp"

/// CPU seconds of timed runs against each other.
namespace tripoint {

/// Factor >= 1 within which the same work was seen to differ from itself: exp of the mean log ratio plus two
/// of its standard errors.
/// @param pairs CPU seconds of the same run, twice a round   @return NaN with fewer than two rounds or a time
/// that is not above 0
[[nodiscard]] double noise_floor(const std::vector<std::pair<double, double>>& pairs);

/// Engines, presets and modes at the case's own resolution against each other, by their medians.
[[nodiscard]] std::vector<TimingPair> timing_pairs(const CaseResult&);

[[nodiscard]] double median(std::vector<double>);
/// Median of the absolute deviations from the median.
[[nodiscard]] double median_deviation(const std::vector<double>&);

}  // namespace tripoint
