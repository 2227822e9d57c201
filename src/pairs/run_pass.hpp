// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "pairs/pass.hpp"
#include "particles/neighbours.hpp"
#include "particles/particles.hpp"

namespace tripoint {

/// Adds each term's sum to its columns; the caller sets their values before.
/// @param function made for clusters as wide as those of the neighbours   @throws MissingField that a term
/// names and nobody owns
void run_pass(const PassFunction& function, Particles&, Neighbours&, const PairKernels&, int threads);

/// For these entries only, and without finding which are within the support. @param entries of each a bit, as
/// in Clusters::within
void run_pass_among(const PassFunction&, Particles&, Neighbours&, const PairKernels&, int threads,
                    const std::vector<std::uint64_t>& entries);

/// Some of the clusters of a list, ascending.
struct ChosenClusters {
  std::vector<std::uint32_t> clusters;
  std::vector<std::uint8_t> members;  ///< of each, bit l where member l is to be summed; empty: all are
};
/// The clusters of these rows, with these rows alone as members. @param rows each once, ascending
[[nodiscard]] ChosenClusters clusters_of(const Clusters&, const std::vector<std::uint32_t>& rows);

/// Adds each term's sum to the rows of these clusters; to all where none are chosen. As run_pass(), and
/// entries within the support are found for these alone.
void run_pass_in(const PassFunction&, Particles&, Neighbours&, const PairKernels&, int threads,
                 const std::optional<ChosenClusters>&);

/// For these clusters only, and for what acts there (Clusters::acting): terms add nothing where nothing acts.
/// Results of a finding pass for other clusters stay. A finding pass looks at all entries, and must not be
/// asked for some members alone.
void run_pass_over(const PassFunction&, Particles&, Neighbours&, const PairKernels&, int threads,
                   const ChosenClusters&);
/// The same with these columns, in the order of PassFunction::fields.
void run_pass_over(const PassFunction&, const std::vector<double*>& columns, const Particles&, Neighbours&,
                   const PairKernels&, int threads, const ChosenClusters&);

}  // namespace tripoint
