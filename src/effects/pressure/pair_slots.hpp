// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/pressure/pressure_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::pressure {

struct PairSlots : NoPairTerms {
  using rates = OneTermOf<PressurePaper, PressureCorrected, PressureOfSolids>;
  using timed = Terms<PressureCorrected>;
};

}  // namespace tripoint::pressure
