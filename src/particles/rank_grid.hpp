// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// What a particle costs in a step, as far as shares of a scene depend on it, in entries of lists that are looked at. A row and a
/// bond are estimates (decision 037); as many entries are taken for all before there are lists: those of a liquid
/// at rest, two passes over 160 for 8 particles.
struct ParticleCost {
  static constexpr double of_row = 9.0, of_bond = 0.5, guess_of_entries = 40.0;
  /// @param idle it is fixed, and pairs of what is fixed have no work
  [[nodiscard]] static constexpr double at_start(bool idle) { return of_row + (idle ? 0.0 : guess_of_entries); }
};

/// The particles of a scene, as far as it depends on them how ranks share it out.
struct ToShareOut {
  std::span<const Vec3> places;    ///< [m]
  std::span<const char> idle;      ///< of each, 1 as in ParticleCost; empty: none is
  double spacing = 0.0;            ///< [m]
  double reach = 0.0;              ///< of copies [m]
  std::array<bool, 3> periodic{};  ///< a direction that is split has then a cut at its ends too
  Vec3 min{}, max{};               ///< the domain, used in periodic directions only [m]
  [[nodiscard]] bool is_idle(std::size_t i) const { return !idle.empty() && idle[i] != 0; }
};

/// Places of the cuts along each direction, ends included, and whether a direction is cut.
struct Cuts {
  std::array<int, 3> grid{1, 1, 1};
  std::array<std::vector<double>, 3> at;  ///< grid[a] + 1 places [m]
  [[nodiscard]] bool cut(std::size_t a) const { return grid[a] > 1; }
  [[nodiscard]] std::size_t rank_of(const Vec3& place) const;  ///< z slowest
};

/// The greatest cost of a rank over the mean that cuts are left with at the start, and how often LAMMPS bisects for it.
inline constexpr double allowed_at_start = 1.02;
inline constexpr int most_bisections = 20;

/// As LAMMPS makes them at the start, each particle weighed by ParticleCost: equal parts, and where one costs over
/// allowed_at_start of the mean, planes that are bisected towards equal costs. @param grid ranks along each direction
/// @pre there is a particle
[[nodiscard]] Cuts cuts_of(const ToShareOut&, const std::array<int, 3>& grid);

/// How many ranks lie along each direction: of all ways, the one whose step is predicted to be the shortest (decision 038). A
/// step takes what the most rows of a rank cost, copies among them, and what the most entries do: loops over rows and passes over
/// pairs wait for each other. What shares a scene out and what predicts the cost of that both ask it. @param ranks > 0
[[nodiscard]] std::array<int, 3> rank_grid(int ranks, const ToShareOut&);

}  // namespace tripoint
