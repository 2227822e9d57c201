// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Liquid that carries its density: the rate follows from the velocities of neighbours, and the force is the
/// adjoint of it.
namespace tripoint::carried_liquid {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::carried_liquid
