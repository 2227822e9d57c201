// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

/// Bodies that unite and come apart: m, r_cm, I, v and L anew, so that mass, momentum and angular momentum
/// are kept.
namespace tripoint::rigid {

/// bodies[0] absorbs the rest and keeps its row and orientation; the kinetic energy lost is accumulated as
/// merging. A fixed or prescribed bodies[0] keeps its motion. @throws InputError where another of them is
/// fixed or prescribed
void merge(State&, const Event&);
/// Members inside the event's region (of its bodies, or of all) become a body of their own: a new row.
/// @throws InputError when the region holds no member
void split(State&, const Event&);

}  // namespace tripoint::rigid
