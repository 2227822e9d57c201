// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "adapters/bullet/world.hpp"
#include "scene/scene.hpp"

namespace tripoint::bullet {

/// Where a shape belongs.
struct PlaceOfShape {
  Vec3 centre;      ///< the body's centre of mass [m]
  Quaternion axes;  ///< principal frame to world at the start
  bool free = true;
};

/// Parts that have the surface of the shape itself: boxes, spheres, cylinders, meshes, and unions of these,
/// in the principal frame. A mesh that is convex is a hull, and a cylinder with a ball at each end a capsule;
/// another is its triangles, which Bullet takes for bodies that are not free.
/// @return empty for a shape that Bullet has no parts for
/// @throws InputError for a mesh that cannot be read
[[nodiscard]] std::vector<Piece> pieces_of(const Shape&, const PlaceOfShape&);

}  // namespace tripoint::bullet
