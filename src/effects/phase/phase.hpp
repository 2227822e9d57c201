// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Change of phase (Fig. 5; model 8.9): the particles that melt or freeze, and the bodies that result. Heat
/// moves (H, f), and this effect decides by f. Melted particles leave their bodies, and frozen ones join the
/// bodies that they touch. The effect settles the energies.
namespace tripoint::phase {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::phase
