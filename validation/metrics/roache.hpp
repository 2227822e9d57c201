// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace tripoint {

/// What the three finest levels of a ladder say of a value whose truth nobody knows [Roache 1994].
struct RoacheIndex {
  /// (f3 - f2)/(f2 - f1) > 0: the value goes one way. If not, order and limit are no numbers
  bool monotone = false;
  double order = 0.0;   ///< observed
  double limit = 0.0;   ///< f1 + (f1 - f2)/(r^p - 1), extrapolated to step 0
  double index = 0.0;   ///< grid convergence index of the finest value, in its unit: factor |limit - f1|
  double factor = 0.0;  ///< of safety: 1.25 where an order was observed, else 3
};

/// @param step coarse to fine, falling, at least three   @param value at each step
/// @throws InputError where there are fewer than three, or one is no finite number
[[nodiscard]] RoacheIndex roache_index(const std::vector<double>& step, const std::vector<double>& value);

}  // namespace tripoint
