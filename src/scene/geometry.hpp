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

/// Whether the shape itself is turned; parts of a union or difference may be turned besides.
[[nodiscard]] inline bool is_turned(const Shape& s) { return s.rotation != Quaternion{}; }

/// Whether the shape is a box along the axes: min and max are its corners.
[[nodiscard]] inline bool is_upright_box(const Shape& s) {
  return s.kind == Shape::Kind::box && !is_turned(s);
}

/// Whether the shape or any part of it is turned.
[[nodiscard]] bool has_turned_part(const Shape&);

/// The shape without its own rotation.
[[nodiscard]] Shape not_turned(Shape);

/// Centre of the bounding box of the shape that is not turned: its rotation leaves it where it is [m].
[[nodiscard]] Vec3 turning_centre(const Shape&);

/// The map that turns points of the shape that is not turned [m].
[[nodiscard]] std::function<Vec3(const Vec3&)> turning(const Shape&);

/// Box that holds the shape (for a difference: that of the shape that is cut, shortened where a half space
/// along an axis cuts it). @throws InputError for a mesh that cannot be read
[[nodiscard]] Bounds bounds(const Shape&);

/// Centre of the shape's symmetry, where it has one that a lattice should share: sphere, cylinder (of its
/// whole axis).
[[nodiscard]] std::optional<Vec3> symmetry_centre(const Shape&);

/// Whether a point lies in the shape. @param spacing of the lattice [m]: a mesh is voxelised finer than it
[[nodiscard]] std::function<bool(const Vec3&)> inside_of(const Shape&, double spacing);

/// A point's image within periodic sides.
[[nodiscard]] Vec3 put_back(const Scene&, Vec3 point);

/// Whether an image of a point lies in a region of the scene. One that ends beyond a periodic side goes on
/// within.
[[nodiscard]] std::function<bool(const Vec3&)> inside_region(const Scene&, const Shape&);

/// Volume [m3] by formula or, for a mesh, the divergence theorem; empty for a union or difference, which may
/// overlap.
[[nodiscard]] std::optional<double> volume(const Shape&);

// --- the plane of x and z, scene.dimensions = 2

/// A shape without its y: what it covers of the plane of x and z, as a slab 1 m deep about y = 0.
/// @throws InputError where it has no such form: turned out of the plane, or a mesh
[[nodiscard]] Shape planar(const Shape&);

/// Whether what happens is the same all along a direction: it repeats, or is left out.
[[nodiscard]] inline bool is_endless(const Scene& s, std::size_t axis) {
  return s.periodic[axis] || (axis == 1 && s.is_planar());
}

/// Whether solids cannot strain along a direction either.
[[nodiscard]] inline bool is_held_across(const Scene& s, std::size_t axis) {
  return is_endless(s, axis) && !(axis == 1 && s.plane_stress);
}

/// Extent of a particle along y [m].
[[nodiscard]] inline double cell_depth(const Scene& s) { return s.is_planar() ? layer_depth : s.spacing; }

/// Puts the bodies, events, inflows and sources of a scene into the plane y = 0.
/// @throws InputError naming what points out of it
void make_planar(Scene&);

}  // namespace tripoint
