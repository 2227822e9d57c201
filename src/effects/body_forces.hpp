// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "effects/world.hpp"

namespace tripoint {

/// What the members of one rigid body feel from all others (18): sums of pressure, viscous and elastic (with hourglass) forces,
/// and their torques about the centre of mass.
struct BodyForces {
  Vec3 pressure, viscous, elastic;                       ///< [N]
  Vec3 pressure_torque, viscous_torque, elastic_torque;  ///< [N m]
  [[nodiscard]] Vec3 force() const { return pressure + viscous + elastic; }
  [[nodiscard]] Vec3 torque() const { return pressure_torque + viscous_torque + elastic_torque; }
};
/// One entry a body, sums in order of id; empty where no effect of the scene makes forces.
[[nodiscard]] std::vector<BodyForces> forces_on_bodies(const World&);
/// The same for the bodies that move only, zero for others; empty when none does. @param sums is used again from call to call
void forces_on_moving_bodies(const World&, std::vector<BodyForces>& sums);

}  // namespace tripoint
