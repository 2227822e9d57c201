// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "effects/fluid/listed_pairs.hpp"
#include "effects/fluid/material_numbers.hpp"
#include "world/world.hpp"

namespace tripoint::fluid {

/// Jitter below which the difference of two jittered places rounds to that of their lattice places [spacings]. Each place is off
/// by less than a quarter, and both together by less than a half.
inline constexpr double laid_jitter_limit = 0.25;

/// Whether the jitter of a scene leaves two particles of one lattice nearer to their own places of it than to others. Fixed walls
/// then press from their lattice. Walls that do not jitter are there already.
[[nodiscard]] inline bool has_laid_walls(const Scene& scene) {
  const auto is_smooth = [](const Body& b) { return b.motion == Motion::fixed && !b.jitters; };
  const auto is_rough = [](const Body& b) { return b.motion == Motion::fixed && b.jitters; };
  const bool all_smooth = std::ranges::any_of(scene.bodies, is_smooth) && std::ranges::none_of(scene.bodies, is_rough);
  return scene.jitter > 0.0 && scene.jitter < laid_jitter_limit && !all_smooth;
}

/// Difference of two places of one lattice, from that of two that are jittered. @param away, and the result [spacings]
[[nodiscard]] inline Vec3 laid(const Vec3& away) { return {std::round(away.x), std::round(away.y), std::round(away.z)}; }

/// A resumed run finds rows in another order, and places of walls that are off by their last bit. A millionth of a spacing, or of
/// the rest density, is far above the effect of that on a sum. It is also far below any size that matters. So both runs have the
/// same bits.
[[nodiscard]] inline double to_a_millionth(double x) { return std::ldexp(std::round(std::ldexp(x, 20)), -20); }

/// Liquid feels the fixed walls of a jittered scene from the lattice that they were laid on (model 8.4). A wall never moves, so
/// nothing evens out the jitter. Without this the first layer of liquid would lie on rough ground, and all layers above would
/// bear its pattern. The pair passes see walls where they are; the difference due to the lattice places is added after them.
class LaidWalls {
 public:
  /// After the pass of densities: adds W(|d'|) - W(|d|) to each pair of liquid and fixed wall within the support. d = r_j - r_i,
  /// and d' is that from the lattice place of the wall particle. The wall's own part is that of Walls.
  void lay_densities(World&, const PairKernels&);
  /// After the pass of rates: the same to the pressure force, so that it is the gradient of the energy at these densities.
  void lay_forces(World&, const PairKernels&);
  /// Groups have changed: look again which particles are walls.
  void clear() {
    pairs_.clear();
    moves_.clear();
  }

 private:
  /// A neighbour, and the change of its distance vector by the lattice [m].
  struct Pair {
    std::uint32_t row, image;
    Vec3 added;
  };
  void find(World&);
  void find_moves(World&);
  template <class Give>
  void each_pair(const World&, Give give) const;

  std::vector<Vec3>
      moves_;  ///< by id, from where jitter put a particle of a fixed wall to its place on the lattice [m]; 0 of all others
  ListedPairs<Pair> pairs_;  ///< of liquid near fixed walls, and of these near liquid
};

}  // namespace tripoint::fluid
