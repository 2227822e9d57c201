// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "liquids/fixed_walls.hpp"
#include "liquids/listed_pairs.hpp"
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::lattice_walls {

/// Liquid feels the fixed walls of a jittered scene from the lattice that they were laid on (model 8.4). A
/// wall never moves, so nothing evens out the jitter. Without this the first layer of liquid would lie on
/// rough ground, and all layers above would bear its pattern. The pair passes see walls where they are; the
/// difference due to the lattice places is added after them.
class LatticeSums {
 public:
  /// After the pass of densities: adds W(|d'|) - W(|d|) to each pair of liquid and fixed wall within the
  /// support. d = r_j - r_i, and d' is that from the lattice place of the wall particle. The wall's own part
  /// is that of Walls.
  void lay_densities(State&, const PairKernels&);
  /// After the pass of rates: the same to the pressure force, so that it is the gradient of the energy at
  /// these densities.
  void lay_forces(State&, const PairKernels&, const Rows&);
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
  void find(State&);
  void find_moves(State&);
  template <class Give>
  void each_pair(const State&, Give give) const;

  /// By id, from where jitter put a particle of a fixed wall to its place on the lattice [m]; 0 of all others
  std::vector<Vec3> moves_;
  liquid::ListedPairs<Pair> pairs_;  ///< of liquid near fixed walls, and of these near liquid
};

}  // namespace tripoint::lattice_walls
