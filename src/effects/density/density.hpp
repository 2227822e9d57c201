// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Summed density (4), which pressure, viscosity and the paper's heat divide by.
namespace tripoint::density {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::density
