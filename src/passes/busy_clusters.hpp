// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "passes/run_pass.hpp"
#include "sph/pass.hpp"
#include "world/world.hpp"

namespace tripoint {

/// Of each row of these whether it never moves: a member of a fixed rigid body. Beyond Particles::moving() all are.
[[nodiscard]] std::vector<char> fixed_rows(const World&, std::size_t rows);

/// Clusters that a pass has work in, and the entries of their lists that act: a dry wall and the inside of a body meet nothing,
/// and cost nothing. What is left out keeps every bit: the forces between what never acts on each other are sums of zeros, and
/// the density of what is fixed among what is fixed stays what the first pass over the present lists found. Of use where no term
/// works on every pair, as heat does.
///
/// Of a scene that is shared out (World::copies), clusters of copies alone are left out too: their sums are their owners'.
class BusyClusters {
 public:
  /// The lists, the groups, the own pairs or the motion of bodies have changed: all is found anew.
  void drop_clusters() {
    known_ = false;
    own_is_known_ = false;
  }
  /// Over all pairs, of what is this process's own.
  void sum_own(const PassFunction&, World&, const PairKernels&);
  /// @param leaves_own whether the density terms leave own pairs out, as the corrected one does
  void sum_density(const PassFunction&, World&, const PairKernels&, bool leaves_own);
  /// After sum_density() over the same lists.
  void sum_rates(const PassFunction&, World&, const PairKernels&) const;
  /// What no step reads of fixed particles (World::forms_fixed): the density of those that sleep, and the forces on all of them.
  void sum_fixed_density(const PassFunction&, World&, const PairKernels&) const;
  void sum_fixed_rates(const PassFunction&, World&, const PairKernels&) const;
  /// What lists, a density and a rates pass cost for each row in a step, shared among the members of a cluster, as ParticleCost
  /// weighs them; of copies nothing. @param steps from new lists to new lists   @param all no pair is left out
  /// @pre has_entries()
  [[nodiscard]] std::vector<double> cost_by_row(const World&, double steps, bool all) const;
  /// Whether there are lists of these particles, and it is known where they have work.
  [[nodiscard]] bool has_entries(const World&, bool all) const;

 private:
  void find(World&, bool leaves_own);
  void learn_still(const PassFunction&, World&, const PairKernels&);
  void sum_listed(const PassFunction&, World&, const PairKernels&);
  void find_own(const World&);
  void keep(const PassFunction&, const World&);
  void put_back(const PassFunction&, Particles&) const;

  bool own_is_known_ = false;
  std::optional<ChosenClusters> own_;  ///< with a member that is no copy; none: there are no copies
  bool known_ = false;
  ChosenClusters in_density_, in_rates_;
  std::vector<std::uint32_t> still_;         ///< rows of the clusters whose density is kept
  std::vector<double> density_;              ///< of each of them, one column after the other
  bool placed_ = false;                      ///< World::placed as the density was kept
  long still_known_ = -1;                    ///< Neighbours::whole_lists() that the next are of
  std::vector<double> density_among_still_;  ///< of Neighbours::still_ids() among themselves, one column after the other
};

}  // namespace tripoint
