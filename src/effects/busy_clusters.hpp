// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "effects/run_pass.hpp"
#include "effects/world.hpp"
#include "sph/pass.hpp"

namespace tripoint {

/// Clusters that a pass has work in, and the entries of their lists that act: a dry wall and the inside of a body meet nothing, and cost nothing. What is left out keeps every
/// bit: the forces between what never acts on each other are sums of zeros, and the density of what is fixed among what is fixed
/// stays what the first pass over the present lists found. Of use where no term works on every pair, as heat does.
class BusyClusters {
 public:
  /// The lists, the groups, the own pairs or the motion of bodies have changed: all is found anew.
  void forget() { known_ = false; }
  /// @param leaves_own whether the density terms leave own pairs out, as the corrected one does
  void sum_density(const PassFunction&, World&, const PairKernels&, bool leaves_own);
  /// After sum_density() over the same lists.
  void sum_rates(const PassFunction&, World&, const PairKernels&) const;

 private:
  void find(World&, bool leaves_own);
  void keep(const PassFunction&, const Particles&);
  void put_back(const PassFunction&, Particles&) const;
  [[nodiscard]] bool stays(const Particles&) const;

  bool known_ = false;
  ChosenClusters in_density_, in_rates_;
  std::vector<std::uint32_t> still_;                  ///< rows of the clusters whose density is kept
  std::vector<double> density_;                       ///< of each of them, one column after the other
  std::vector<std::uint32_t> fixed_;                  ///< rows that never move
  std::vector<Vec3> place_;                           ///< of each of them, as the density was kept [m]
};

}  // namespace tripoint
