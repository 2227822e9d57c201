// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <vector>

namespace tripoint {

/// The error that a ladder of resolutions leaves at step 0. A scheme's own error vanishes there, a wrong
/// constant does not.
struct LadderLimit {
  /// Extrapolated error, signed as the errors
  double value = std::numeric_limits<double>::quiet_NaN();
  /// standard; NaN where the levels do not tell it
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
};

/// error = limit + a h, limit + a h^2, limit + a h^4 or limit + a h + b h^2 by least squares, weighted by
/// 1/h: the model that fits best. Its residual gives the uncertainty (half of Student's 95 % interval), to
/// which that of the errors is added. Magnitudes that are not monotone may hide a change of sign: the sign
/// that fits best is taken. Fewer than three levels, or no number among them: NaN.
/// @param step coarse to fine, falling   @param uncertainty standard, of each error; may be empty
[[nodiscard]] LadderLimit ladder_limit(const std::vector<double>& step, const std::vector<double>& error,
                                       const std::vector<double>& uncertainty);

}  // namespace tripoint
