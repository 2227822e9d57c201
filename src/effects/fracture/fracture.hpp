// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// Fracture of deformable bodies (model 2, 8.8): bonds that are stretched too far end for good, and broken
/// parts become bodies.
namespace tripoint::fracture {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::fracture
