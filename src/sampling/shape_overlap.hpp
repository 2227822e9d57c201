// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "scene/initial_state.hpp"

namespace tripoint {

struct Scene;

/// Two bodies (rows of Scene::bodies, a < b) whose shapes share space.
struct SharedSpace {
  std::size_t a = 0, b = 0;
  double thickness = 0.0;  ///< across the thickest place of it that was found [m]
  Vec3 place;              ///< there [m]
};

/// Found from the shapes alone, of every pair of kinds; the particles only say where to look. Faces that
/// touch share no space: what is thinner than a fiftieth of a spacing (a quarter of one beside a mesh, whose
/// field is no finer) does not count.
/// @param fineness factor of these and of the search's last steps, 1 or less
[[nodiscard]] std::vector<SharedSpace> shared_spaces(const Scene&, const InitialState&,
                                                     double fineness = 1.0);

}  // namespace tripoint
