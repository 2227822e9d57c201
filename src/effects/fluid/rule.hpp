// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene/scene.hpp"

namespace tripoint::fluid {

/// Why liquids of the scene can have no numerical bulk viscosity, whatever scene.bulk_viscosity says; "" where they can: something is liquid and never
/// freezes, which changes densities at once; density, pressure and state are corrected; and the scene clamps, so that a free surface or a contact can be.
[[nodiscard]] std::string no_bulk_viscosity(const Scene&);

}  // namespace tripoint::fluid
