// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

namespace tripoint::arithmetic {

/// The word of [model] viscosity.
inline constexpr std::string_view word = "arithmetic";

}  // namespace tripoint::arithmetic
