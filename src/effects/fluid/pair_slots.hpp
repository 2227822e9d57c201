// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/fluid_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::fluid {

/// Pressure and viscosity share a slot: they read much the same fields of a pair. Pressure is alone where another effect
/// brings the viscosity.
struct PairSlots {
  using rates = SlotList<Slot<Together<PressurePaper, ViscosityPaper>, Together<PressurePaper, ViscosityCentral>,
                              Together<PressurePaper, ViscosityLaplacian>, Together<PressurePaper, ViscosityCentralWeighted>,
                              Together<PressureCorrected, ViscosityPaper>, Together<PressureCorrected, ViscosityCentral>,
                              Together<PressureCorrected, ViscosityLaplacian>,
                              Together<PressureCorrected, ViscosityCentralWeighted>, PressurePaper, PressureCorrected>>;
  using alone = Together<ViscousSpread<ViscosityPaper>, ViscousSpread<ViscosityCentral>, ViscousSpread<ViscosityLaplacian>,
                         ViscousSpread<ViscosityCentralWeighted>>;
  using timed = Together<PressureCorrected, ViscosityCentral>;
};

}  // namespace tripoint::fluid
