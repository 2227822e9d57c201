// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "sph/pass.hpp"

namespace tripoint {

/// Every pass at every choice of forms (0 = off, then in the order of the slots in pair_passes_unit.cpp), as one vector unit has
/// them.
struct PairPasses {
  PassFunction (*density)(const std::array<int, 2>&);
  PassFunction (*rates)(const std::array<int, 2>&);
  PassFunction (*spread)(const std::array<int, 1>&);  ///< of viscosity: 1 as printed, 2 central, 3 laplacian, 4 central weighted
  PassFunction (*wall_extrapolation)(const std::array<int, 1>&);  ///< 1 even, 2 weighted as central viscosity
  PassFunction transport;
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
