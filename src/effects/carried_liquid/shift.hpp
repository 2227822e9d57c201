// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/scheme.hpp"
#include "state/state.hpp"

namespace tripoint::carried_liquid {

/// Velocities of the shift [m/s], against the unevenness (model 8.12): 0 at free surfaces and of what is
/// driven. @param sound_speed of the scene [m/s]
void set_shift(State&, const Scheme&, double sound_speed);

}  // namespace tripoint::carried_liquid
