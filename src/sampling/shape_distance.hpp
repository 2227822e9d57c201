// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint {

using PlaceFunction = std::function<double(const Vec3&)>;

/// Signed distance to the shape's surface, below zero inside [m]. Exact for boxes, spheres, cylinders and
/// half spaces; of a union or difference never too large in size; of a mesh its field, to which distances
/// beyond 1.5 spacings are alike.
[[nodiscard]] PlaceFunction distance_of(const Shape&, double spacing);

/// Share of a cell (a cube about the place) that the shape fills, 0 to 1; exact where a plane face along the
/// axes cuts the cell.
/// @param side of the cell [m] @param spacing as for distance_of
[[nodiscard]] PlaceFunction filled_share(const Shape&, double side, double spacing);

/// Mass, centre and moments of the shape, filled with one density; empty where the shape has no finite
/// bounds. In the plane those of the layer y = 0, 1 m deep, as its particles have them.
[[nodiscard]] std::optional<MassProperties> mass_of_shape(const Shape&, double density, double spacing,
                                                          Dimensions = Dimensions::three);

}  // namespace tripoint
