// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint {

struct Mesh;

/// Particles of the scene, row = id, bodies in order: on its lattice, and then let down into equilibrium
/// where the scene says `settle`.
/// @throws InputError (no particles, mesh not closed, nothing to settle with, ...)
[[nodiscard]] InitialState sample(const Scene&);

/// How sample() lets liquids down. The program that has a solver sets it, once, before it samples: this room
/// and the judge know none.
using Settler = InitialState (*)(const Scene&, InitialState);
void set_settler(Settler) noexcept;

/// Row in /particles/bodies of each [[body]]; -1 for a liquid.
[[nodiscard]] std::vector<int> body_rows(const Scene&);

/// Mass, centre, principal moments (ascending) and axes of the given particles; moments at round-off become
/// 0.
[[nodiscard]] MassProperties mass_properties(const std::vector<Vec3>& position,
                                             const std::vector<double>& mass);

/// Mass, centre and moments of the body that the mesh encloses, filled with one density.
[[nodiscard]] MassProperties mass_properties(const Mesh&, double density);

/// Whether the particles of a body weigh what the case, or the shape, says.
[[nodiscard]] bool carries_given_mass(const Body&);

/// Masses of the particles of a body: density times the volume of a cell each. Where mass, centre or moments
/// are given, each is multiplied by a polynomial of second degree in its place, whose ten numbers make the
/// sums exact. So every engine sees the same body.
/// @throws InputError where the particles cannot carry them: too few, or a mass would not be positive
[[nodiscard]] std::vector<double> particle_masses(const Scene&, const Body&, const std::vector<Vec3>& places);

}  // namespace tripoint
