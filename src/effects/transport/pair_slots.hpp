// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/transport/transport_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::transport {

struct PairSlots : NoPairTerms {
  using alone = OneTermOf<TransportForces, TransportForcesAndMeans>;
};

}  // namespace tripoint::transport
