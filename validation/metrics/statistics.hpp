// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace tripoint {

/// Mean of a series that fluctuates about a steady value, with what its own correlation leaves known of it.
struct StationaryMean {
  double value = 0.0;        ///< of the samples after the burn-in
  double uncertainty = 0.0;  ///< standard; NaN where the blocks reach no plateau
  std::size_t burn_in = 0;   ///< samples that were cut from the front
  double effective = 0.0;    ///< number of independent samples: variance of one sample over that of the mean
  bool plateau = false;      ///< the error has stopped rising with the length of the blocks
};

/// Burn-in: the cut, of at most half the series, that gives the remaining mean the least error [White 1997,
/// marginal standard error rule]. Error: from means of blocks of 1, 2, 4, ... samples while there are eight
/// of them [Flyvbjerg & Petersen 1989]. The largest counts. Unless the last has stopped rising within its own
/// scatter there is no plateau: the series is too short to say.
/// @param series equally spaced samples; fewer than 8 give NaN
[[nodiscard]] StationaryMean stationary_mean(const std::vector<double>& series);

}  // namespace tripoint
