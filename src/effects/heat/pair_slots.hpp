// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/heat/heat_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::heat {

struct PairSlots : NoPairTerms {
  using density = OneTermOf<HeatMoment>;
  using rates = OneTermOf<HeatFlowPaper, HeatFlowCorrected>;
};

}  // namespace tripoint::heat
