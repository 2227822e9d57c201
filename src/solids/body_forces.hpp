// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "state/state.hpp"

namespace tripoint {

/// Forces on the members of one rigid body from all others (18). These are the sum of each of State::forces
/// that bodies feel, in their order, and its torque about the centre of mass.
struct BodyForces {
  std::array<Vec3, most_forces> forces;   ///< [N]
  std::array<Vec3, most_forces> torques;  ///< [N m]
  std::size_t count = 0;                  ///< of them that the scene has
  [[nodiscard]] Vec3 force() const { return sum_of(forces); }
  [[nodiscard]] Vec3 torque() const { return sum_of(torques); }

 private:
  [[nodiscard]] Vec3 sum_of(const std::array<Vec3, most_forces>& list) const {
    Vec3 sum;
    for (std::size_t k = 0; k < count; ++k) sum += list[k];
    return sum;
  }
};
/// One entry a body, sums in order of id over what this process owns; empty where no effect of the scene
/// makes forces.
[[nodiscard]] std::vector<BodyForces> forces_on_bodies(const State&);
/// The same for the bodies that move only, zero for others, of all processes that share the scene; empty when
/// none does. @param sums is used again from call to call
void forces_on_moving_bodies(const State&, std::vector<BodyForces>& sums);

}  // namespace tripoint
