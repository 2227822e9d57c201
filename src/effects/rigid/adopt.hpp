// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "world/world.hpp"

namespace tripoint::rigid {

/// Bodies that gained or lost members by phase change: m, r_cm, I, v and L anew from the members as they moved (model 8.9), so
/// that mass, momentum and angular momentum are kept; what leaves a body moves on with v + omega x r. Fixed and prescribed bodies
/// keep their motion. The kinetic energy that each body's joining cost is told in World::change.
void adopt_members(World&);

}  // namespace tripoint::rigid
