// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

namespace tripoint {

/// Converts a number that others wrote as a whole number, cut towards zero. Beyond the range of T it becomes
/// the nearest end of that range, and NaN becomes 0.
template <class T>
[[nodiscard]] constexpr T whole_number(double v) noexcept {
  // This is exactly one past the greatest value: the remainder of the division does not count.
  constexpr double end =
      2.0 * static_cast<double>(std::numeric_limits<T>::max() / 2 + 1);  // NOLINT(bugprone-integer-division)
  if (v >= end) return std::numeric_limits<T>::max();
  if (std::numeric_limits<T>::is_signed ? v < -end : v < 0.0) return std::numeric_limits<T>::min();
  return v == v ? static_cast<T>(v) : T{0};
}
static_assert(whole_number<int>(1e300) == std::numeric_limits<int>::max() &&
              whole_number<int>(-2147483648.0) == std::numeric_limits<int>::min());
static_assert(whole_number<long>(9223372036854775807.0) == std::numeric_limits<long>::max() &&
              whole_number<unsigned>(-1.0) == 0u && whole_number<int>(-2.9) == -2);

}  // namespace tripoint
