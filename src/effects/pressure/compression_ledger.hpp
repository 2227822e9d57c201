// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::pressure {

/// Energy of the core of pairs that act [J], of the rows that this process owns. @param share  of the core
/// [1]
[[nodiscard]] double core_energy(const State&, const liquid::SceneNumbers&, double share);
/// Adds the energy of compression, core and interfaces of all that exerts pressure [J] (model 8.11).
void add_compression(const State&, const liquid::SceneNumbers&, Ledger&);

}  // namespace tripoint::pressure
