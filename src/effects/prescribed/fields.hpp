// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Where a grip took a particle.
namespace tripoint::field {

inline constexpr Field<double> grip_x{"grip.x", "m"}, grip_y{"grip.y", "m"}, grip_z{"grip.z", "m"};
inline constexpr VectorField<double> grip{grip_x, grip_y, grip_z};

}  // namespace tripoint::field
