// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// Plastic flow of deformable bodies (model 8.8): the strain that has flowed, per particle, and the energy
/// that it cost.
namespace tripoint::plastic {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::plastic
