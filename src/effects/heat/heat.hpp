// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "effects/effect.hpp"

/// Heat conduction (21), as printed or in the enthalpy form of model 8.6.
namespace tripoint::heat {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::heat
