// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/heat/heat_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::heat {

struct PairSlots {
  using density = SlotList<Slot<HeatMoment>>;
  using rates = SlotList<Slot<HeatFlowPaper, HeatFlowCorrected>>;
};

}  // namespace tripoint::heat
