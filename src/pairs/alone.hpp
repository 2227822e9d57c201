// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "pairs/pass.hpp"
#include "pairs/run_pass.hpp"
#include "state/state.hpp"

/// Terms that have a pass of their own (PairSlots::alone).
namespace tripoint {

/// The pass of a term, as wide as the clusters of the scene. @throws std::logic_error where it has none
[[nodiscard]] PassFunction alone_pass(const State&, const PairTerm&);

/// Sums over all clusters, from 0 on.
void sum_alone(State&, const PairTerm&, const PairKernels&);
/// Adds the sums of these clusters, and ghosts take them from their owners. All processes call it.
void add_alone(State&, const PassFunction&, const PairKernels&, const ChosenClusters&);
/// The same for rows whose sums nobody reads of a ghost.
void add_alone_here(State&, const PassFunction&, const PairKernels&, const ChosenClusters&);

/// The same into memory of the caller, which no column holds. @param sums of each field that the term adds to
/// a list with one number a row
void add_alone_to(std::vector<std::vector<double>>& sums, State&, const PassFunction&, const PairKernels&,
                  const ChosenClusters&);

}  // namespace tripoint
