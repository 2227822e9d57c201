// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace tripoint {

/// Whether the particles of a body weigh what the case, or the shape, says.
[[nodiscard]] bool carries_given_mass(const Body&);

/// Masses of the particles of a body: density times the volume of a cell each. Where mass, centre or moments
/// are given, each is multiplied by a polynomial of second degree in its place, whose ten numbers make the
/// sums exact. So every engine sees the same body.
/// @throws InputError where the particles cannot carry them: too few, or a mass would not be positive
[[nodiscard]] std::vector<double> particle_masses(const Scene&, const Body&, const std::vector<Vec3>& places);

}  // namespace tripoint
