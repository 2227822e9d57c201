// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// Elastic bodies, (10)-(17): strain of each particle from its own list of reference vectors, and the forces of strain energy and
/// hourglass energy on it and its body neighbours.
namespace tripoint::elastic {

[[nodiscard]] EffectSpec spec(const Scene&);
[[nodiscard]] std::unique_ptr<Effect> make(const Scene&);

}  // namespace tripoint::elastic
