// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "world/world.hpp"

namespace tripoint::rigid {

/// Bodies that gained or lost members by phase change: m, r_cm, I, v and L anew from the members as they
/// moved (model 8.9). Mass, momentum and angular momentum are kept. Particles that leave a body move on with
/// v + omega x r. Fixed and prescribed bodies keep their motion. World::change tells the kinetic energy that
/// each body's joining cost.
void adopt_members(World&);

}  // namespace tripoint::rigid
