// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/fluid_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::fluid {

struct PairSlots : NoPairTerms {
  using Pressures = OneTermOf<PressurePaper, PressureCorrected, PressureOfSolids>;
  /// None of them where another effect brings the viscosity.
  using Viscosities = OneOf<Terms<>, Terms<ViscosityPaper>, Terms<ViscosityCentral>,
                            Terms<ViscosityLaplacian>, Terms<ViscosityCentralWeighted>>;
  using rates = decltype(Pressures{} * Viscosities{});
  using alone = OneTermOf<ViscousSpread<ViscosityPaper>, ViscousSpread<ViscosityCentral>,
                          ViscousSpread<ViscosityLaplacian>, ViscousSpread<ViscosityCentralWeighted>>;
  using timed = Terms<PressureCorrected, ViscosityCentral>;
};

}  // namespace tripoint::fluid
