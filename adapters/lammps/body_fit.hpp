// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <vector>

#include "io/trajectory.hpp"
#include "scene/initial_state.hpp"

namespace tripoint::lammps {

/// State of a rigid body from its particles, which is all that fix rigid shows of its orientation:
/// centre and velocity as mass means, rotation since time 0 by Horn's quaternion fit (exact for a rigid set),
/// angular velocity by w = I^-1 L. A collinear body gets the shortest rotation of its axis.
[[nodiscard]] BodyState fit_body(const MassProperties& start, const std::vector<std::size_t>& members, const InitialState&,
                                 const Snapshot& now);

}  // namespace tripoint::lammps
