// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// Cost of a particle in a step, as far as the sharing of a scene depends on it. The unit is one list entry
/// that a pass looks at, the mean of a density and a rates pass. The weights are measured, except that of a
/// bond (decision 039).
struct ParticleCost {
  static constexpr double of_density = 0.6, of_rates = 1.4;  ///< of an entry, in each step
  static constexpr double of_listing = 1.3;                  ///< of an entry, as lists are made
  static constexpr double of_step = 5.0, of_lists = 30.0;    ///< of a row, in each step and as lists are made
  static constexpr double of_bond = 0.5;
  /// Before there are lists: steps from new lists to new lists, and entries of a liquid at rest, 160 for 8
  /// particles.
  static constexpr double guess_of_steps = 10.0, guess_of_entries = 20.0;
  /// Cost of the entries of its list, beside the cost of its row.
  static constexpr double idle_at_start = guess_of_entries * (of_density + of_listing) / guess_of_steps;
  static constexpr double busy_at_start =
      guess_of_entries * (of_density + of_rates + of_listing / guess_of_steps);
  [[nodiscard]] static constexpr double of_row(double steps = guess_of_steps) {
    return of_step + of_lists / steps;
  }
  /// @param idle it is fixed, and pairs of fixed particles have no work: it is summed over as lists are made,
  /// and then no more
  [[nodiscard]] static constexpr double at_start(bool idle) {
    return of_row() + (idle ? idle_at_start : busy_at_start);
  }
};

/// The particles of a scene, as far as it depends on them how ranks share it out.
struct ToShareOut {
  std::span<const Vec3> places;    ///< [m]
  std::span<const char> idle;      ///< of each, 1 as in ParticleCost; empty: none is
  double spacing = 0.0;            ///< [m]
  double reach = 0.0;              ///< of ghosts [m]
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

/// The greatest cost of a rank over the mean that cuts are left with at the start, and how often LAMMPS
/// bisects for it.
inline constexpr double allowed_at_start = 1.02;
inline constexpr int most_bisections = 20;

/// Cuts as LAMMPS makes them at the start, each particle weighed by ParticleCost. The parts are equal. Where
/// one costs more than allowed_at_start times the mean, planes are bisected towards equal costs. @param grid
/// ranks along each direction
/// @pre there is a particle
[[nodiscard]] Cuts cuts_of(const ToShareOut&, const std::array<int, 3>& grid);

/// How many ranks lie along each direction: of all ways, the one whose step is predicted to be the shortest
/// (decision 038). The time of a step is the greatest cost of rows of any rank, ghosts included, plus the
/// greatest cost of entries. They add, because loops over rows and passes over pairs wait for each other.
/// Sharing a scene out and predicting its cost both use this function.
/// @param ranks > 0
[[nodiscard]] std::array<int, 3> rank_grid(int ranks, const ToShareOut&);

}  // namespace tripoint
