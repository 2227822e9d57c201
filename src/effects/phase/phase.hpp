// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Change of phase (Fig. 5; model 8.9): what melts, what freezes and what that makes of bodies. Heat moves (H, f); this effect
/// decides by f, lets the melted leave their bodies and the frozen join those that they touch, and settles the energies.
namespace tripoint::phase {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::phase
