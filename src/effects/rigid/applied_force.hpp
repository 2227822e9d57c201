// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/body_table.hpp"

/// Constant forces on free rigid bodies, [[force]]. Such a force has a potential: the body's point moves and
/// the force does not.
namespace tripoint::rigid {

/// v += dt F/m, L += dt (r_point - r_cm) x F (18)-(19); the work goes to the account of gravity, whose entry
/// holds the potential.
void push_by_applied_forces(State&, std::size_t body, double dt);

/// -F . r_point, summed over the body's forces [J]
[[nodiscard]] double potential_of_applied_forces(const State&, std::size_t body);

/// |sum F|/m [m/s2]
[[nodiscard]] double applied_acceleration(const State&, std::size_t body);

}  // namespace tripoint::rigid
