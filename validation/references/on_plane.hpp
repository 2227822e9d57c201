// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {

/// A law of contact that the case hands to all engines, `friction` or `restitution`; empty where it states
/// none.
[[nodiscard]] std::optional<double> law_of_contact(const Job&, const std::string& name);

/// One free box or ball that touches the face of one held or steadily moved box, with what its motion along
/// the face depends on.
struct BodyOnPlane {
  std::size_t body = 0, plane = 0;       ///< rows in Job::bodies
  Shape::Kind shape = Shape::Kind::box;  ///< of the free body
  Vec3 up, along;                        ///< unit vectors: out of the plane, and of the motion in it
  /// Of the centre above the plane: a ball's radius; half the box along the motion [m]
  double height = 0.0, half_length = 0.0;
  double pull = 0.0, press = 0.0;  ///< gravity along the motion and into the plane [m/s2]
  /// Of the body along the motion as the plane sees it [m/s], about up x along [rad/s]
  double speed = 0.0, spin = 0.0;
  double friction = 0.0;
  Vec3 plane_velocity;           ///< [m/s]
  std::vector<BodyState> start;  ///< of all bodies, one row each
};
/// @throws InputError unless the scene is that, with pull and velocity along one line
[[nodiscard]] BodyOnPlane body_on_plane(const ReferenceInput&, const char* function);

}  // namespace tripoint
