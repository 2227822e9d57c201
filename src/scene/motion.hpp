// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// Motion of a fixed or prescribed body by its keyframes (position linear, rotation slerp), velocity their
/// derivative.
struct PrescribedState {
  Vec3 position, velocity, angular_velocity;
  Quaternion rotation;
};
/// @param centre the body's centre of mass at time 0 [m]
[[nodiscard]] PrescribedState prescribed_state(const std::vector<Keyframe>&, const Vec3& centre,
                                               const Vec3& velocity, const Vec3& angular_velocity,
                                               double time);

}  // namespace tripoint
