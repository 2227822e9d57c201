// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Force on a particle by strain energy and hourglass energy.
namespace tripoint::field {

inline constexpr Field<double> elastic_force_x{"elastic_force.x", "N"},
    elastic_force_y{"elastic_force.y", "N"}, elastic_force_z{"elastic_force.z", "N"};
inline constexpr VectorField<double> elastic_force{elastic_force_x, elastic_force_y, elastic_force_z};

}  // namespace tripoint::field
