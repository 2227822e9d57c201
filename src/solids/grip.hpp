// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/motion.hpp"

namespace tripoint {

/// Where a grip has brought a place by `time`, how fast the place moves [m/s], and how the grip has turned
/// [rad/s]. The keyframes of the grip move a frame, and all that it took moves with that frame. @param place
/// as the grip took it [m]
[[nodiscard]] inline PrescribedState carried(const Event& grip, const Vec3& place, double time) {
  const Keyframe& from = grip.keyframes.front();
  PrescribedState s = prescribed_state(grip.keyframes, {}, {}, {}, time);
  s.rotation = s.rotation * conjugate(from.rotation);
  const Vec3 arm = rotate(s.rotation, place - from.position);
  s.velocity += cross(s.angular_velocity, arm);
  s.position += arm;
  return s;
}

}  // namespace tripoint
