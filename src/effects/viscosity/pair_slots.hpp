// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/viscosity/viscous_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::viscosity {

struct PairSlots : NoPairTerms {
  using rates = OneTermOf<ViscosityPaper, ViscosityCentral, ViscosityLaplacian, ViscosityCentralWeighted>;
  using alone = OneTermOf<ViscousSpread<ViscosityPaper>, ViscousSpread<ViscosityCentral>,
                          ViscousSpread<ViscosityLaplacian>, ViscousSpread<ViscosityCentralWeighted>>;
  using timed = Terms<ViscosityCentral>;
};

}  // namespace tripoint::viscosity
