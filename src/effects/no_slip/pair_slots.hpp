// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/no_slip/wall_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::no_slip {

struct PairSlots : NoPairTerms {
  using alone = OneTermOf<WallExtrapolation, WallExtrapolationWeighted>;
};

}  // namespace tripoint::no_slip
