// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sph/density_term.hpp"
#include "sph/pair_slots.hpp"

namespace tripoint::density {

struct PairSlots {
  using density = SlotList<Slot<DensityPaper>>;
};

}  // namespace tripoint::density
