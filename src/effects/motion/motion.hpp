// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Motion of all particles that are no members of rigid bodies: liquids and deformable solids, by the forces
/// of the other effects.
namespace tripoint::motion {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::motion
