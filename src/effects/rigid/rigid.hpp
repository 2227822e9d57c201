// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Rigid bodies (18)-(20): free flight, fixed, prescribed, merged and split by event.
namespace tripoint::rigid {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::rigid
