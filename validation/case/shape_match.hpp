// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/initial_state.hpp"
#include "validation/case/preflight.hpp"

namespace tripoint {

/// A warning for each free body whose particles differ from its shape by more than 1 % in mass or, of a
/// solid, in moments of inertia or the place of its centre (of its least extent). Each particle counts with
/// the moment of its cell here.
[[nodiscard]] std::vector<Finding> unlike_their_shapes(const Scene&, const InitialState&);
/// A note for each rigid body that fills its shape, and whose particles are so few that their moments alone
/// are more than 1 % off.
[[nodiscard]] std::vector<Finding> moment_notes(const Scene&, const InitialState&);

/// What a body of a mesh is: its file says no unit, so that size and mass are the first sight of a wrong one.
struct MeshBody {
  std::size_t body = 0;       ///< row of Scene::bodies
  std::size_t triangles = 0;  ///< of its meshes together
  Vec3 extent;                ///< [m]
  MassProperties shape;       ///< of the shape, filled with the body's density
  double particles = 0.0;     ///< mass of the body's particles [kg]
};
[[nodiscard]] std::vector<MeshBody> mesh_bodies(const Scene&, const InitialState&);
/// A sentence for each.
[[nodiscard]] std::vector<Finding> mesh_notes(const Scene&, const InitialState&);

}  // namespace tripoint
