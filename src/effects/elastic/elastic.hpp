// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// Elastic bodies, (10)-(17). The strain of each particle follows from its own list of reference vectors.
/// Strain energy and hourglass energy exert forces on it and its body neighbours.
namespace tripoint::elastic {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::elastic
