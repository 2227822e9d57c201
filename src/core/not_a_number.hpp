// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

namespace tripoint {

/// A value that nobody knows.
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace tripoint
