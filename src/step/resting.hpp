// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

namespace tripoint {

/// Which bodies' members can sleep: those of fixed bodies, in a scene in which no event is to come that could
/// move one.
/// @param beyond how far around what something can reach they stay awake [m]
[[nodiscard]] Resting fixed_bodies(const State&, double beyond);

}  // namespace tripoint
