// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "adapters/bullet/world.hpp"
#include "scene/scene.hpp"

class btRigidBody;
class btTypedConstraint;

namespace tripoint::bullet {

/// Bullet's constraint for a joint: of the free bodies themselves, so that the solver holds it. Nothing is
/// made for a distance. The limits of its joint are those of the scene; Bullet's own laws of a slider,
/// damping along it among them, are set to none.
/// @param one,other bodies of the joint in Bullet; `other` may be Bullet's own fixed body
[[nodiscard]] std::unique_ptr<btTypedConstraint> constraint_of(const Joint&, btRigidBody& one,
                                                               btRigidBody& other);

}  // namespace tripoint::bullet
