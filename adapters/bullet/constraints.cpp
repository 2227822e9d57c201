// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/constraints.hpp"

#include <btBulletDynamicsCommon.h>

namespace tripoint::bullet {
namespace {

btVector3 in_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A frame of the body: at a point, with an axis of the frame along a direction of the world.
btTransform frame_of(const btRigidBody& body, const Vec3& place, const btVector3& own, const Vec3& along) {
  const btTransform world(shortestArcQuat(own, in_bullet(along)), in_bullet(place));
  return body.getCenterOfMassTransform().inverse() * world;
}

/// Bullet's angle is that of the first of its bodies.
std::unique_ptr<btTypedConstraint> hinge(const Joint& j, btRigidBody& one, btRigidBody& other) {
  const btVector3 z(0, 0, 1);
  auto made = std::make_unique<btHingeConstraint>(one, other, frame_of(one, j.point, z, *j.axis),
                                                  frame_of(other, j.point, z, *j.axis));
  constexpr double softness = 0.9, bias = 0.3;  // as they come; a relaxation of 1 would throw it back
  if (j.limits) made->setLimit((*j.limits)[0], (*j.limits)[1], softness, bias, 0.0);
  if (j.motor && j.motor->speed) made->enableAngularMotor(true, *j.motor->speed, 1e30);
  return made;
}

std::unique_ptr<btTypedConstraint> slider(const Joint& j, btRigidBody& one, btRigidBody& other) {
  const btVector3 x(1, 0, 0);
  auto made = std::make_unique<btSliderConstraint>(other, one, frame_of(other, j.point, x, *j.axis),
                                                   frame_of(one, j.point, x, *j.axis), true);
  made->setLowerLinLimit(j.limits ? (*j.limits)[0] : 1.0);  // free where the lower is above the upper
  made->setUpperLinLimit(j.limits ? (*j.limits)[1] : -1.0);
  made->setLowerAngLimit(0.0);
  made->setUpperAngLimit(0.0);
  made->setDampingDirLin(0.0);
  made->setDampingDirAng(0.0);
  if (j.motor && j.motor->speed) {
    made->setPoweredLinMotor(true);
    made->setTargetLinMotorVelocity(*j.motor->speed);
    made->setMaxLinMotorForce(1e30);
  }
  return made;
}

}  // namespace

std::unique_ptr<btTypedConstraint> constraint_of(const Joint& j, btRigidBody& one, btRigidBody& other) {
  const btVector3 x(1, 0, 0);
  const Vec3 own{1.0, 0.0, 0.0};
  switch (j.kind) {
    case Joint::Kind::hinge:
      return hinge(j, one, other);
    case Joint::Kind::slider:
      return slider(j, one, other);
    case Joint::Kind::ball:
      return std::make_unique<btPoint2PointConstraint>(
          other, one, other.getCenterOfMassTransform().inverse() * in_bullet(j.point),
          one.getCenterOfMassTransform().inverse() * in_bullet(j.point));
    case Joint::Kind::fixed:
      return std::make_unique<btFixedConstraint>(other, one, frame_of(other, j.point, x, own),
                                                 frame_of(one, j.point, x, own));
    case Joint::Kind::universal: {
      btVector3 anchor = in_bullet(j.point), first = in_bullet(*j.other_axis), second = in_bullet(*j.axis);
      return std::make_unique<btUniversalConstraint>(other, one, anchor, first, second);
    }
    case Joint::Kind::distance:
      break;
  }
  return nullptr;
}

}  // namespace tripoint::bullet
