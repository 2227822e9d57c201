// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>

#include "scene/scene.hpp"

namespace tripoint {

/// A box along the axes [m]; a half space has infinite corners.
struct Bounds {
  Vec3 min, max;
  [[nodiscard]] Vec3 extent() const { return max - min; }
};

/// Box that holds the shape (for a difference: that of the shape that is cut, shortened where a half space along an axis cuts
/// it). @throws InputError for a mesh that cannot be read
[[nodiscard]] Bounds bounds(const Shape&);

/// Centre of the shape's symmetry, where it has one that a lattice should share: sphere, cylinder (of its whole axis).
[[nodiscard]] std::optional<Vec3> symmetry_centre(const Shape&);

/// Whether a point lies in the shape. @param spacing of the lattice [m]: a mesh is voxelised finer than it
[[nodiscard]] std::function<bool(const Vec3&)> inside_of(const Shape&, double spacing);

/// Volume [m3] by formula or, for a mesh, the divergence theorem; empty for a union or difference, which may overlap.
[[nodiscard]] std::optional<double> volume(const Shape&);

}  // namespace tripoint
