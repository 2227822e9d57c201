// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Fields of the laws of contact of pairs of materials (model 8.18).
namespace tripoint::field {

inline constexpr VectorField<double> friction_force{"friction_force", "N"};
/// Moment about the particle of its friction forces, which act halfway to the other solid
inline constexpr VectorField<double> friction_couple{"friction_couple", "J"};
/// Stretch of the spring that holds a particle where it sticks
inline constexpr VectorField<double> slip{"slip", "m"};
/// Force that the laws ask for at a particle, before it is shared out among its pairs
inline constexpr VectorField<double> traction{"traction", "N"};
/// Where the face of the body looks: slope of its kernel sum, times a power of its share
inline constexpr VectorField<double> outward{"outward", "1/m4"};
inline constexpr VectorField<double> contact_normal{"contact_normal", "1"};
/// Sum of the parts of the pair forces along the normal
inline constexpr Field<double> contact_load{"contact_load", "N"};
inline constexpr VectorField<double> contact_velocity{"contact_velocity", "m/s"};

}  // namespace tripoint::field
