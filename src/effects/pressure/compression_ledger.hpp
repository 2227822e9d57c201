// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::pressure {

/// Adds the energy of compression, core and interfaces of all that exerts pressure [J] (model 8.11).
void add_compression(const State&, const liquid::SceneNumbers&, const PairKernels&, Ledger&);

}  // namespace tripoint::pressure
