// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

/// State that follows from places and velocities of one time, particle by particle: before the rate pass.
namespace tripoint::pressure {

/// @throws Diverged where a particle that is no wall has the density of two layers in one plane. Then its
/// body or liquid and another overlap by one spacing. For printed (4) there is no such limit: it sums masses,
/// so an overlap looks like a heavy neighbour.
void refuse_overlap(const State&, const liquid::SceneNumbers&);
/// (9), printed or scaled (model 8.3).
void set_pressure(State&, const liquid::SceneNumbers&, const Rows&);
/// V^2 p, with the pressure of the bulk viscosity, over the kernel's lattice moment: the share of each
/// particle in the corrected pressure force.
void set_pressure_shares(State&, const liquid::SceneNumbers&, const Rows&);

}  // namespace tripoint::pressure
