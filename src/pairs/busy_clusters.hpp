// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "pairs/pass.hpp"
#include "pairs/run_pass.hpp"
#include "state/state.hpp"

namespace tripoint {

/// For each of these rows, whether it never moves: a member of a fixed rigid body. Beyond Particles::moving()
/// all rows are fixed.
[[nodiscard]] std::vector<char> fixed_rows(const State&, std::size_t rows);

/// Clusters in which a pass has work, and the entries of their lists that act. A dry wall and the inside of a
/// body meet nothing, and cost nothing. Skipping these clusters changes no bit. Forces between groups that
/// never act on each other are sums of zeros. The density of fixed particles that have only fixed neighbours
/// stays as first computed for these lists. The class helps only where no term works on every pair; heat
/// conduction does.
///
/// In a shared scene (State::ghosts) clusters of ghosts alone are left out too: their owners form their sums.
class BusyClusters {
 public:
  /// The lists, the groups, the excluded pairs or the motion of bodies have changed: all is found anew.
  void drop_clusters() {
    known_ = false;
    own_is_known_ = false;
  }
  /// Over all pairs, for this process's own particles.
  void sum_own(const PassFunction&, State&, const PairKernels&);
  /// @param leaves_own whether the density terms leave excluded pairs out, as the corrected one does
  void sum_density(const PassFunction&, State&, const PairKernels&, bool leaves_own);
  /// After sum_density() over the same lists.
  void sum_rates(const PassFunction&, State&, const PairKernels&) const;
  /// Values of fixed particles that no step reads (State::forms_fixed): the density of those that sleep, and
  /// the forces on all of them.
  void sum_fixed_density(const PassFunction&, State&, const PairKernels&) const;
  void sum_fixed_rates(const PassFunction&, State&, const PairKernels&) const;
  /// Cost of lists, a density and a rates pass for each row in a step, weighed as in ParticleCost. It is
  /// shared among the members of a cluster; ghosts cost nothing. @param steps from new lists to new lists
  /// @param all no pair is left out
  /// @pre has_entries()
  [[nodiscard]] std::vector<double> cost_by_row(const State&, double steps, bool all) const;
  /// Whether there are lists of these particles, and it is known where they have work.
  [[nodiscard]] bool has_entries(const State&, bool all) const;

 private:
  void find(State&, bool leaves_own);
  void learn_still(const PassFunction&, State&, const PairKernels&);
  void sum_listed(const PassFunction&, State&, const PairKernels&);
  void find_own(const State&);
  void keep(const PassFunction&, const State&);
  void put_back(const PassFunction&, Particles&) const;

  bool own_is_known_ = false;
  std::optional<ChosenClusters> own_;  ///< with a member that is no ghost; none: there are no ghosts
  bool known_ = false;
  ChosenClusters in_density_, in_rates_;
  std::vector<std::uint32_t> still_;  ///< rows of the clusters whose density is kept
  std::vector<double> density_;       ///< of each of them, one column after the other
  bool placed_ = false;               ///< State::placed as the density was kept
  long still_known_ = -1;             ///< Neighbours::whole_lists() that the next are of
  /// Of Neighbours::still_ids() among themselves, one column after the other
  std::vector<double> density_among_still_;
};

}  // namespace tripoint
