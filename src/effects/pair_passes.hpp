// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "effects/density/density_terms.hpp"
#include "effects/fluid/fluid_terms.hpp"
#include "effects/fluid/transport_terms.hpp"
#include "effects/fluid/wall_terms.hpp"
#include "effects/heat/heat_terms.hpp"
#include "sph/pass.hpp"

namespace tripoint {

/// The slots of each pass, one line each.
using DensityPass = Pass<Slot<DensityPaper, NumberDensity>, Slot<HeatMoment>>;
using RatePass = Pass<Slot<Together<PressurePaper, ViscosityPaper>, Together<PressurePaper, ViscosityCentral>, Together<PressurePaper, ViscosityLaplacian>,
                           Together<PressureCorrected, ViscosityPaper>, Together<PressureCorrected, ViscosityCentral>, Together<PressureCorrected, ViscosityLaplacian>>,
                      Slot<HeatFlowPaper, HeatFlowCorrected>>;
using WallExtrapolationPass = Pass<Slot<WallExtrapolation>>;
using WallForcePass = Pass<Slot<WallPressureForce>>;
using TransportPass = Pass<Slot<TransportForces>>;

/// Every pass at every choice of forms (0 = off, then in the order of the slot), as one vector unit has them.
struct PairPasses {
  PassFunction (*density)(const std::array<int, DensityPass::slots>&);
  PassFunction (*rates)(const std::array<int, RatePass::slots>&);
  PassFunction wall_extrapolation, wall_force, transport;
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
