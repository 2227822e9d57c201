// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pair_passes.hpp"

/// Compiled once for each vector unit, and once for any machine, a particle at a time.
namespace tripoint {

template <>
PairPasses pair_passes_for<Unit>() {
  constexpr int lanes = TRIPOINT_UNIT_LANES;
  return {&DensityPass::choose<lanes, Unit>, &RatePass::choose<lanes, Unit>, WallExtrapolationPass::choose<lanes, Unit>({1}), WallForcePass::choose<lanes, Unit>({1}),
          TransportPass::choose<lanes, Unit>({1})};
}

}  // namespace tripoint
