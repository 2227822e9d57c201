// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"
#include "particles/catalogue.hpp"
#include "state/step_numbers.hpp"

/// Fields of liquids and contact (4), (7) to (9) that no other effect knows.
namespace tripoint::field {

inline constexpr Field<double> number_density{"number_density", "1/m3"};
/// V^2 p over the kernel's lattice moment
inline constexpr Field<double> pressure_share{"pressure_share", "Pa m6"};
inline constexpr VectorField<double> viscous_force{"viscous_force", "N"};
inline constexpr Field<double> number_density_before{"number_density_before", "1/m3"},
    bulk_pressure{"bulk_pressure", "Pa"};  ///< at the last places; of the numerical bulk viscosity
/// Of solids, at the last places
inline constexpr Field<double> solid_density_before{"solid_density_before", "1/m3"};
/// Velocity that viscous pairs see: predicted to the full step for liquids, mirrored for walls.
inline constexpr VectorField<double> viscous_velocity{"viscous_velocity", "m/s"};
inline constexpr Field<double> viscosity{"viscosity", "Pa s"}, rest_density{"rest_density", "kg/m3"};
inline constexpr Field<double> solid{"solid", "1"};  ///< 1 for solids and walls, 0 for liquids
/// 1 where a liquid sticks to this solid, 0 where it slips
inline constexpr Field<double> stick{"stick", "1"};
/// Sums of walls over the liquid near them: viscous weights, and velocities times these.
inline constexpr Field<double> wall_weight{"wall.weight", "Pa s/m5"};
inline constexpr VectorField<double> wall_velocity{"wall.velocity", "Pa/m4"};
/// Force of the background pressure, and of the stress that the transport velocity carries (model 8.3).
inline constexpr VectorField<double> background{"background", "N"};
inline constexpr VectorField<double> transport_force{"transport_force", "N"};
/// Sums over neighbours for the mean pressure and the damping of sound (model 8.3).
inline constexpr Field<double> pressure_around{"pressure_around", "Pa/m3"}, nearing{"nearing", "1/(s m3)"};

}  // namespace tripoint::field

/// What the next step needs of those before it.
namespace tripoint::liquid {

inline constexpr StepNumber half_step{"half_step", 0.0};  ///< length of the last kick of liquids [s]

}  // namespace tripoint::liquid
