// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "pairs/pass.hpp"

namespace tripoint {

/// Every pass that effects have brought slots for (pairs/pair_slots.hpp), as one vector unit has them. A pass sums the wanted
/// terms that it has.
struct PairPasses {
  PassFunction (*density)(std::span<const PairTerm> wanted);
  PassFunction (*rates)(std::span<const PairTerm> wanted);
  PassFunction (*alone)(const PairTerm&);  ///< of one term; null where no effect has brought it
  PassFunction timed;                      ///< rates that show which width is fastest
  std::span<const PairTerm> terms;         ///< all that are compiled, each as often as a form of a slot has it
};

/// As compiled for a vector unit, for clusters as wide as it.
template <class ForUnit>
[[nodiscard]] PairPasses pair_passes_for();

/// For clusters of that many particles, made for the machine's vectors. @param lanes 1, 4 or 8   @throws InputError for another,
/// and for one that this machine has no vectors for
[[nodiscard]] PairPasses pair_passes(int lanes);

/// Lanes that are fastest here, as measured once, in about a millisecond.
[[nodiscard]] int best_lanes();

}  // namespace tripoint
