// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::pressure {

/// Energy that the numerical bulk viscosity of liquids has taken [J].
inline constexpr EnergyAccount taken_by_bulk_viscosity{"bulk_viscous"};

/// zeta of scene.bulk_viscosity [1]; 0 where liquids of this scene can have none (no_bulk_viscosity).
[[nodiscard]] double bulk_viscosity(const Scene&);

/// Numerical bulk viscosity of liquids: a pressure q = zeta rho0 c h (d delta/dt)/delta [Pa] beside that of
/// the equation of state. zeta [1] is given by the scene. rho0 is at most SceneNumbers::damped_density: the
/// damping of a light liquid that meets a heavy one then stays slow enough for a step of sound. Nothing else
/// takes the energy of sound in water: without it the sound that a lattice emits as it breaks up stays as
/// noise. The rate is that of the number density over the last step. The work of q is then -q (d
/// delta/dt)/delta V <= 0, whatever moves. Shear, rotation and solids feel nothing. Momentum and angular
/// momentum are kept, since q acts as the pressure does. Where the pressure is 0, and at a free surface,
/// there is none, and their sum is never negative. Up to its default it needs no bound of the step beside
/// that of sound. A wave of frequency w is damped at w^2 zeta h/c. Forces of the last half step's velocities
/// are then stable while w^2 dt^2 + 2 w^2 zeta (h/c) dt < 4. With w = 2 c/(0.885 h), the fastest wave of the
/// lattice, that is dt < 0.71 h/c at 0.2: sound takes 0.45. Where liquids mix, the heavy one damps the light
/// one faster, and 0.6 h/c is left at four times the density (tests/step/stability_bulk_test.cpp). Also
/// accumulates the energy that it takes, by the trapezoidal rule. To be called once for all new places, after
/// the pressure is known.
void set_bulk_pressure(State&, const liquid::SceneNumbers&);

/// Greatest step over h/c [1] (model 8.10): 0.81 (sqrt(z^2 + 0.885^2) - z), z = 2.12 zeta. Above that of
/// sound, 0.45, up to zeta = 0.2. @param zeta scene.bulk_viscosity or scene.sound_damping [1]
[[nodiscard]] double bulk_viscous_step(double zeta);

}  // namespace tripoint::pressure
