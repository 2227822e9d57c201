// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"

namespace tripoint {

/// A rigid body as its particles make it at one moment: the result of a merge or split, by the conservation
/// laws alone.
struct RigidBody {
  std::vector<std::size_t> members;  ///< particle ids
  std::vector<Vec3> offset;          ///< of the members from the centre [m]
  double mass = 0.0;                 ///< [kg]
  Vec3 centre, velocity;             ///< of the centre of mass [m], P/M [m/s]
  Vec3 angular_momentum;             ///< about the centre [kg m2/s]
  Vec3 inertia;                      ///< principal moments, ascending [kg m2]
  Quaternion axes;                   ///< principal frame to world
  /// Inverse inertia times angular momentum, world [rad/s]; 0 about an axis without moment
  Vec3 angular_velocity;
};

/// Mass, momentum and angular momentum of the members, and the rigid motion that has the same.
/// @param position,velocity,mass of all particles, by id [m], [m/s], [kg]
[[nodiscard]] RigidBody rigid_body(const std::vector<std::size_t>& members, const std::vector<Vec3>& position,
                                   const std::vector<Vec3>& velocity, const std::vector<double>& mass);

/// Kinetic energy of particles [J].
[[nodiscard]] double kinetic_energy(const std::vector<Vec3>& velocity, const std::vector<double>& mass);

}  // namespace tripoint
