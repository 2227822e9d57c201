// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "world/world.hpp"

namespace tripoint::carried_liquid {

/// Velocities that viscous pairs see, by the forces of the state before. @param ahead half a step [s]
void predict_velocities(World&, double ahead);

}  // namespace tripoint::carried_liquid
