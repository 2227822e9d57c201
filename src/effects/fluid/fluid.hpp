// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Liquids and contact, (4) and (7)-(9): number density, equation of state, pressure, viscosity, walls
/// (model 8.1-8.5).
namespace tripoint::fluid {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::fluid
