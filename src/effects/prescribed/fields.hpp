// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Where a grip took a particle.
namespace tripoint::field {

inline constexpr VectorField<double> grip{"grip", "m"};

}  // namespace tripoint::field
