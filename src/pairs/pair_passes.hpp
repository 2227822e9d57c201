// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "pairs/pass.hpp"

namespace tripoint {

/// The tables of functions that effects have brought terms for (pairs/pair_slots.hpp), as one vector unit has
/// them.
struct PairPasses {
  std::span<const PassFunction> densities, rates_of_scenes, single;
  PassFunction timed;  ///< rates that show which width is fastest

  /// The functions that sum most of the wanted terms and no other; of none where the table has none.
  [[nodiscard]] PassFunction density(std::span<const PairTerm> wanted) const;
  [[nodiscard]] PassFunction rates(std::span<const PairTerm> wanted) const;
  /// Of one term; null where no effect has brought it.
  [[nodiscard]] PassFunction alone(const PairTerm&) const;
};

/// As compiled for a vector unit, for clusters as wide as it.
template <class ForUnit>
[[nodiscard]] PairPasses pair_passes_for();

/// For clusters of that many particles, made for the machine's vectors. @param lanes 1, 4 or 8   @throws
/// InputError for another, and for one that this machine has no vectors for
[[nodiscard]] PairPasses pair_passes(int lanes);

/// Lanes that are fastest here, as measured once, in about a millisecond.
[[nodiscard]] int best_lanes();

}  // namespace tripoint
