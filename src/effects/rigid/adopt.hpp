// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

namespace tripoint::rigid {

/// Bodies that gained or lost members by phase change: m, r_cm, I, v and L anew from the members as they
/// moved (model 8.9). Mass, momentum and angular momentum are kept. Particles that leave a body move on with
/// v + omega x r. Fixed and prescribed bodies keep their motion. State::change tells the kinetic energy that
/// each body's joining cost.
void adopt_members(State&);

}  // namespace tripoint::rigid
