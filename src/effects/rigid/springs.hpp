// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

/// Springs and dampers between points of rigid bodies, [[spring]] (model 8.16).
namespace tripoint::rigid {

/// One half kick of all springs. The first goes through them in order, with the velocities before; the second
/// goes back, with those after: its mirror image, so that damping is of second order too.
void pull_by_springs(State&, double dt);
[[nodiscard]] double spring_energy(const State&);  ///< [J]
/// Greatest step that resolves the swing and the damping of each spring [s]; infinite where there is none.
[[nodiscard]] double spring_step(const State&);

}  // namespace tripoint::rigid
