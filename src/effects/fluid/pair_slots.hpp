// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/fluid_terms.hpp"
#include "effects/fluid/transport_terms.hpp"
#include "effects/fluid/wall_terms.hpp"
#include "sph/density_term.hpp"
#include "sph/pair_slots.hpp"

namespace tripoint::fluid {

/// Pressure and viscosity share a slot: they read much the same fields of a pair.
struct PairSlots {
  using density = SlotList<Slot<DensityPaper, NumberDensity>>;
  using rates =
      SlotList<Slot<Together<PressurePaper, ViscosityPaper>, Together<PressurePaper, ViscosityCentral>,
                    Together<PressurePaper, ViscosityLaplacian>, Together<PressurePaper, ViscosityCentralWeighted>,
                    Together<PressureCorrected, ViscosityPaper>, Together<PressureCorrected, ViscosityCentral>,
                    Together<PressureCorrected, ViscosityLaplacian>, Together<PressureCorrected, ViscosityCentralWeighted>>>;
  using alone = Together<ViscousSpread<ViscosityPaper>, ViscousSpread<ViscosityCentral>, ViscousSpread<ViscosityLaplacian>,
                         ViscousSpread<ViscosityCentralWeighted>, WallExtrapolation, WallExtrapolationWeighted, TransportForces,
                         TransportForcesAndMeans>;
  using timed = Together<PressureCorrected, ViscosityCentral>;
};

}  // namespace tripoint::fluid
