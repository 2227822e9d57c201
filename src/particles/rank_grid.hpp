// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "core/vec3.hpp"

namespace tripoint {

/// How many ranks lie along each direction: of all ways, the one with the least area of cuts (decision 021). What shares a scene
/// out and what predicts the cost of that both ask it. @param ranks > 0   @param length of the box [m]
[[nodiscard]] std::array<int, 3> rank_grid(int ranks, const Vec3& length, const std::array<bool, 3>& periodic);

}  // namespace tripoint
