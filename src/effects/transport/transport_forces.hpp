// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

/// Transport velocity, the scene's choice for vortical flow without free surface [Adami, Hu, Adams 2013].
/// Particles move with v + dt/2 (background force)/m, so that they stay even. The momentum that the
/// difference carries is a force.
namespace tripoint::transport {

/// Sets the background force and the stress force from the present places and the last shift [N]. Where
/// has_transport_means(), it also sets two pressures of liquids (model 8.3). With s = scene.mean_pressure,
/// the pressure becomes p_i + s V0/S0 sum W (p_j - p_i) [Pa], summed over liquid neighbours. With zeta =
/// scene.sound_damping, the numerical bulk viscosity is q = -zeta rho0 c h div v [Pa]. @pre the pressure is
/// that of each particle's own density
void set_transport_forces(State&, const liquid::SceneNumbers&, const PairKernels&);
/// w = dt/2 (background force)/m of liquids, for the step that begins [m/s].
void set_shift(State&, double dt);

}  // namespace tripoint::transport
