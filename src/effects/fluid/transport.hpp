// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/material_numbers.hpp"
#include "world/world.hpp"

/// Transport velocity, the scene's choice for vortical flow without free surface [Adami, Hu, Adams 2013]: particles move
/// with v + dt/2 (background force)/m, so that they stay even, and the momentum that the difference carries is a force.
namespace tripoint::fluid {

/// @throws InputError where the scene's choice cannot hold: free bodies, or pressure clamped at free surfaces
[[nodiscard]] bool uses_transport_velocity(const Scene&);

/// Background and stress forces from the present places and the last shift.
void set_transport_forces(World&, const SceneNumbers&, const PairKernels&);
/// w = dt/2 (background force)/m of liquids, for the step that begins [m/s].
void set_shift(World&, double dt);

}  // namespace tripoint::fluid
