// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/body_table.hpp"

/// Forces and torques on free rigid bodies, [[force]]. A constant force has a potential: the body's point
/// moves and the force does not. Torques, and forces that begin or end, have none: the entry `applied_force`
/// takes their work.
namespace tripoint::rigid {

namespace account {
using namespace tripoint::account;
inline constexpr EnergyAccount applied_work{"applied_work"};  ///< of forces and torques without a potential
}  // namespace account

[[nodiscard]] bool has_forces_without_potential(const Scene&);

/// v += dt F/m, L += dt (r_point - r_cm) x F (18)-(19); the work goes to the energy account of gravity, whose
/// entry holds the potential.
void push_by_applied_forces(State&, std::size_t body, double dt);

/// -F . r_point, summed over the body's forces [J]
[[nodiscard]] double potential_of_applied_forces(const State&, std::size_t body);

/// |sum F|/m [m/s2]
[[nodiscard]] double applied_acceleration(const State&, std::size_t body);

}  // namespace tripoint::rigid
