// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Particles that the scene moves, not forces: held in place, gripped, or on their way in. Members of rigid
/// bodies are not among them: those move with their body.
namespace tripoint::prescribed {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::prescribed
