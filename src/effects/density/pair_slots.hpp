// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/density/density_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::density {

struct PairSlots : NoPairTerms {
  using density = OneTermOf<DensityPaper, NumberDensity, SolidNumberDensity>;
};

}  // namespace tripoint::density
