// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "state/body_table.hpp"

/// Rows of the body table: made from their members, and read as one value.
namespace tripoint::rigid {

/// Motion of a body, for the formulas of (18)-(20) and for merging and splitting.
struct BodyMotion {
  double mass = 0.0;
  Vec3 centre, velocity, L, omega;  ///< [m], [m/s], about its centre [kg m2/s], [rad/s]
  [[nodiscard]] Vec3 velocity_at(const Vec3& r) const { return velocity + cross(omega, r - centre); }
};
[[nodiscard]] BodyMotion motion_of(const State&, std::size_t body);
/// Whether it is a rigid body that moves by the forces on it.
[[nodiscard]] bool is_free(const State&, std::size_t body);
/// Principal frame to world frame.
[[nodiscard]] Quaternion principal_to_world(const State&, std::size_t body);
/// Kinetic energy [J], of translation and of the axes that turn.
[[nodiscard]] double kinetic_energy(const State&, std::size_t body);
/// -M g . r [J]
[[nodiscard]] double potential_energy(const State&, std::size_t body);

/// Mass, centre, inertia and the members' reference places from where the members are now; the orientation
/// stays. The motion of the body is not changed. A body without members dies.
void measure(State&, std::size_t body);
/// The same from the rows of its members, in order of id.
void measure(State&, std::size_t body, const std::vector<std::size_t>& rows);

/// Angular velocity from L (19), within the axes that the body may turn about.
void update_spin(State&, std::size_t body);
/// I omega [kg m2/s] of a body that is driven from outside, from its angular velocity.
[[nodiscard]] Vec3 spin_momentum(const State&, std::size_t body);
/// Places (and speeds) of the members from centre, orientation and reference: rigid to round-off for ever.
void place_members(State&);
void give_velocities(State&);
/// Lets a fixed or prescribed body, already measured, go on as its outside drives it. @param old its motion
/// before
void go_on_driven(State&, std::size_t body, const BodyMotion& old);

}  // namespace tripoint::rigid
