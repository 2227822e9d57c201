// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/metrics/frame_error.hpp"

namespace tripoint {

/// A norm of one frame with its statistical standard uncertainty.
struct NormValue {
  double value = 0.0, uncertainty = 0.0;
  long worst = -1;  ///< row of the largest sample
};

/// L1, L2, Linf, L2raw or chi of the samples, by weight. With standard errors s of the samples:
/// L2: its expectation is sqrt(b^2 + mean s^2) for a true error b. So mean s^2 is taken off below the root (0
/// where it exceeds the
///   mean square). u follows from the variance 2 s^4 + 4 b^2 s^2 of each square. L2raw leaves the bias in.
/// L1: u holds the spread of the mean and the bias s sqrt(2/pi). Linf: u = max s sqrt(2 ln n), the expected
/// extreme of n. chi: root mean square of error/s; 1 when the stated errors are the real ones; u = 1/sqrt(2
/// n).
[[nodiscard]] NormValue spatial_norm(Norm norm, const FrameError&);

}  // namespace tripoint
