// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "render/camera.hpp"
#include "render/picture.hpp"
#include "render/target.hpp"

namespace tripoint {

/// Objects that a picture shows, and the ground below them.
struct Display {
  std::vector<std::unique_ptr<Target>> targets;
  Vec3 up{0.0, 0.0, 1.0};        ///< against gravity
  std::optional<double> ground;  ///< height of a plane under all of it, along up [m]
  double size = 1.0;             ///< of what is shown: the ground fades away some of it off [m]
};

/// Casts a ray through each pixel, and eight more where it differs from its neighbours. Light comes from the
/// upper left, behind the viewer, with hard shadows. It uses no random numbers: the picture does not depend
/// on the number of threads.
[[nodiscard]] Picture draw(const Display&, const Camera&, int width, int height, int threads);

}  // namespace tripoint
