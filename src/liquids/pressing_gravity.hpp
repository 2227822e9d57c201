// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"

namespace tripoint::liquid {

/// Gravity without its parts along periodic directions, which drive a flow there and press on nothing [m/s2].
[[nodiscard]] inline Vec3 pressing_gravity(const Scene& scene) {
  Vec3 g = scene.gravity;
  for (std::size_t a = 0; a < 3; ++a)
    if (scene.periodic[a]) g[a] = 0.0;
  return g;
}

}  // namespace tripoint::liquid
