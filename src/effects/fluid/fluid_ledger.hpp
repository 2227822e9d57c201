// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/material_numbers.hpp"
#include "world/world.hpp"

namespace tripoint::fluid {

/// Momentum and energies of liquids, and the energy of compression and core of all that exerts pressure (model 8.11).
void add_fluid(const World&, const SceneNumbers&, const PairKernels&, Ledger&);

}  // namespace tripoint::fluid
