// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

/// Solids whose stiffness falls as they melt: `softens`, and the printed band between t_solid and t_melt
/// (Fig. 5).
namespace tripoint::phase {

/// Whether any deformable solid of the scene softens.
[[nodiscard]] bool any_softens(const Scene&);
/// The share of E and mu that the state of each particle leaves, at the start.
void load_stiffness(State&);
/// The same after the state has moved on, at the present strain. Energy that the bonds lose becomes heat of
/// the particle, and energy that they gain is taken from it.
void follow_stiffness(State&);

}  // namespace tripoint::phase
