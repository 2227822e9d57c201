// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Place of a member seen from the centre of mass, in the body's frame at its birth.
namespace tripoint::field {

inline constexpr VectorField<double> reference{"reference", "m"};

}  // namespace tripoint::field
