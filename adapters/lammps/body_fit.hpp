// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <vector>

#include "files/trajectory.hpp"
#include "scene/initial_state.hpp"

namespace tripoint::lammps {

/// State of a rigid body from its particles, because fix rigid shows no more of its orientation. Centre and
/// velocity are mass means. The rotation since time 0 is Horn's quaternion fit (exact for a rigid set). The
/// angular velocity is w = I^-1 L. A collinear body gets the shortest rotation of its axis.
[[nodiscard]] BodyState fit_body(const MassProperties& start, const std::vector<std::size_t>& members,
                                 const InitialState&, const Snapshot& now);

}  // namespace tripoint::lammps
