// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "scene/initial_state.hpp"

namespace tripoint {

struct Scene;

/// Two bodies (rows of Scene::bodies, a < b) with particles nearer than a distance.
struct Overlap {
  std::size_t a = 0, b = 0;
  long pairs = 0;
  double nearest = 0.0;  ///< [m]
  Vec3 difference = {};  ///< of the nearest pair, from the particle of b to that of a [m]
};
[[nodiscard]] std::vector<Overlap> find_overlaps(const Scene&, const InitialState&, double near);

}  // namespace tripoint
