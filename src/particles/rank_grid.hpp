// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "core/vec3.hpp"

namespace tripoint {

/// How many ranks lie along each direction: of all ways, the one with the least area of cuts (decision 021). What shares a scene
/// out and what predicts the cost of that both ask it. @param ranks > 0   @param length of the box [m]
[[nodiscard]] std::array<int, 3> rank_grid(int ranks, const Vec3& length, const std::array<bool, 3>& periodic);

/// What a particle costs in a step, as far as shares of a scene depend on it, in entries of lists that are looked at. A row and a
/// bond are estimates (decision 037); as many entries are taken for all before there are lists: those of a liquid
/// at rest, two passes over 160 for 8 particles.
struct ParticleCost {
  static constexpr double of_row = 4.0, of_bond = 0.5, guess_of_entries = 40.0;
  /// @param idle it is fixed, and pairs of what is fixed have no work
  [[nodiscard]] static constexpr double at_start(bool idle) { return of_row + (idle ? 0.0 : guess_of_entries); }
};

}  // namespace tripoint
