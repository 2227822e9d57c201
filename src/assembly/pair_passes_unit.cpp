// SPDX-License-Identifier: BSD-3-Clause
#include "effects/density/density_terms.hpp"
#include "effects/fluid/fluid_terms.hpp"
#include "effects/fluid/transport_terms.hpp"
#include "effects/fluid/wall_terms.hpp"
#include "effects/heat/heat_terms.hpp"
#include "passes/pair_passes.hpp"

/// Compiled once for each vector unit, and once for any machine, a particle at a time.
namespace tripoint {
namespace {

/// The slots of each pass, one line each.
using DensityPass = FindingPass<Slot<DensityPaper, NumberDensity>, Slot<HeatMoment>>;
using RatePass =
    Pass<Slot<Together<PressurePaper, ViscosityPaper>, Together<PressurePaper, ViscosityCentral>,
              Together<PressurePaper, ViscosityLaplacian>, Together<PressurePaper, ViscosityCentralWeighted>,
              Together<PressureCorrected, ViscosityPaper>, Together<PressureCorrected, ViscosityCentral>,
              Together<PressureCorrected, ViscosityLaplacian>, Together<PressureCorrected, ViscosityCentralWeighted>>,
         Slot<HeatFlowPaper, HeatFlowCorrected>>;
using SpreadPass = Pass<Slot<ViscousSpread<ViscosityPaper>, ViscousSpread<ViscosityCentral>, ViscousSpread<ViscosityLaplacian>,
                             ViscousSpread<ViscosityCentralWeighted>>>;
using WallExtrapolationPass = Pass<Slot<WallExtrapolation, WallExtrapolationWeighted>>;
using TransportPass = Pass<Slot<TransportForces>>;

}  // namespace

template <>
PairPasses pair_passes_for<Unit>() {
  constexpr int lanes = TRIPOINT_UNIT_LANES;
  return {&DensityPass::choose<lanes, Unit>, &RatePass::choose<lanes, Unit>, &SpreadPass::choose<lanes, Unit>,
          &WallExtrapolationPass::choose<lanes, Unit>, TransportPass::choose<lanes, Unit>({1})};
}

}  // namespace tripoint
