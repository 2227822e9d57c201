// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Place of a member seen from the centre of mass, in the body's frame at its birth.
namespace tripoint::field {

inline constexpr Field<double> reference_x{"reference.x", "m"}, reference_y{"reference.y", "m"},
    reference_z{"reference.z", "m"};
inline constexpr VectorField<double> reference{reference_x, reference_y, reference_z};

}  // namespace tripoint::field
