// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/material_numbers.hpp"
#include "effects/world.hpp"

namespace tripoint::fluid {

/// Whether liquids of this scene have a numerical bulk viscosity: where a free surface or a contact can be (clamp), with the corrected density,
/// pressure and equation of state, and nothing melts or freezes, which changes densities at once.
[[nodiscard]] bool has_bulk_viscosity(const Scene&);

/// Numerical bulk viscosity of liquids: pressure q = zeta rho0 c h (d delta/dt)/delta [Pa] beside that of the equation of state, zeta = 0.2 [1].
/// Nothing else takes the energy of sound in water: what a lattice lets go as it breaks up stays as noise. The rate is of the number density over the
/// last step, so that the work of q is -q (d delta/dt)/delta V <= 0, whatever moves; shear, rotation and solids feel nothing, and momentum and angular
/// momentum are kept, since q acts as the pressure does. Where the pressure is 0 there is none, and their sum is never negative.
/// Also books what it takes, by the trapezoidal rule. To be called once for all new places, after the pressure is known.
void set_bulk_pressure(World&, const SceneNumbers&);

}  // namespace tripoint::fluid
