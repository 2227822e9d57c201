// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

/// The sine about an offset that explains most of a series.
struct DominantFrequency {
  double frequency = 0.0;               ///< [Hz]
  double uncertainty = 0.0;             ///< standard, of a sine in noise of the size of the remainder [Hz]
  double amplitude = 0.0, share = 0.0;  ///< of the sine; of the variance that it explains [1]
  std::string problem;                  ///< why there is none
};

/// By least squares, scanned from one and a half periods in the series to a quarter of the rate of samples,
/// then refined. For a signal that is no sine the first harmonic counts. @param time rising [s]
[[nodiscard]] DominantFrequency dominant_frequency(const std::vector<double>& time,
                                                   const std::vector<double>& value);

}  // namespace tripoint
