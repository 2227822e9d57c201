// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "particles/catalogue.hpp"

/// The catalogue's part for liquids and contact.
namespace tripoint::field {

inline constexpr Field<double> number_density{"number_density", "1/m3"}, volume{"volume", "m3"}, pressure{"pressure", "Pa"};
inline constexpr Field<double> pressure_share{"pressure_share", "Pa m6"};  ///< V^2 p over the kernel's lattice sum
inline constexpr Field<double> force_x{"force.x", "N"}, force_y{"force.y", "N"}, force_z{"force.z", "N"};  ///< of pressure
inline constexpr Field<double> viscous_force_x{"viscous_force.x", "N"}, viscous_force_y{"viscous_force.y", "N"}, viscous_force_z{"viscous_force.z", "N"};
/// Velocity that viscous pairs see: predicted to the full step for liquids, extrapolated for walls.
inline constexpr Field<double> viscous_velocity_x{"viscous_velocity.x", "m/s"}, viscous_velocity_y{"viscous_velocity.y", "m/s"}, viscous_velocity_z{"viscous_velocity.z", "m/s"};
inline constexpr Field<double> viscosity{"viscosity", "Pa s"}, rest_density{"rest_density", "kg/m3"};
inline constexpr Field<double> solid{"solid", "1"};  ///< 1 for solids and walls, 0 for liquids
inline constexpr Field<double> stick{"stick", "1"};  ///< 1 where a liquid sticks to this solid, 0 where it slips
/// Number of the body whose members exert nothing on each other: -1 liquid, 0 all walls, 1 + body for free bodies.
inline constexpr Field<double> group{"group", "1"};
inline constexpr Field<double> wall_weight{"wall.weight", "1/m3"}, wall_pressure{"wall.pressure", "Pa/m3"};
inline constexpr Field<double> wall_lever_x{"wall.lever.x", "kg/m5"}, wall_lever_y{"wall.lever.y", "kg/m5"}, wall_lever_z{"wall.lever.z", "kg/m5"};
inline constexpr Field<double> wall_velocity_x{"wall.velocity.x", "1/m2/s"}, wall_velocity_y{"wall.velocity.y", "1/m2/s"}, wall_velocity_z{"wall.velocity.z", "1/m2/s"};

}  // namespace tripoint::field
