// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Force on a particle by strain energy and hourglass energy.
namespace tripoint::field {

inline constexpr VectorField<double> elastic_force{"elastic_force", "N"};

}  // namespace tripoint::field
