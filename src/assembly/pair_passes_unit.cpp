// SPDX-License-Identifier: BSD-3-Clause
#include "all_pair_slots.hpp"  // made by the build: effects/NAME/pair_slots.hpp of every effect that has one
#include "pairs/pair_passes.hpp"
#include "pairs/pair_slots.hpp"

#ifndef TRIPOINT_EFFECT_LIST
#define TRIPOINT_EFFECT_LIST "effects/effect_list.inc"
#endif

/// Compiled once for each vector unit, and once for any machine, a particle at a time.
namespace tripoint {

#define TRIPOINT_EFFECT(name) \
  namespace name {            \
  struct PairSlots;           \
  }
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT

namespace {

using AllPasses = PassesOf<TRIPOINT_UNIT_LANES, Unit,
#define TRIPOINT_EFFECT(name) name::PairSlots,
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT
                           void>;  // an effect of no slots, which ends the list

}  // namespace

template <>
PairPasses pair_passes_for<Unit>() {
  return {AllPasses::density, AllPasses::rates, AllPasses::alone, AllPasses::timed};
}

}  // namespace tripoint
