// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/mesh.hpp"
#include "surface/implicit_surface.hpp"

/// Bodies whose volume, area and distance are known exactly, as particles on a lattice, and what their
/// surfaces are off by.
namespace tripoint::shapes {

struct ExactBody {
  std::string name;
  double volume = 0.0, area = 0.0, size = 0.0;  ///< [m3], [m2], length that spacings are counted in [m]
  Box box;                                      ///< it lies inside [m]
  std::function<double(const Vec3&)> distance;  ///< to its surface, below zero inside [m]
  std::vector<Vec3> surface;                    ///< places all over the surface [m]
  std::vector<Vec3> offsets;                    ///< of the lattices that are tried, in spacings
};

[[nodiscard]] ExactBody ball(double radius);
/// About the z axis. @param ring radius of the circle in the middle   @param tube radius of the tube [m]
[[nodiscard]] ExactBody torus(double ring, double tube);
/// A box with its faces along the axes, whose lattice fits it: else the particles themselves would fill
/// another one. @param width in x and y   @param height in z [m]
[[nodiscard]] ExactBody slab(double width, double height);

/// Centres of the cubic lattice that lie inside. @param offset of the lattice in spacings
[[nodiscard]] std::vector<Vec3> lattice(const ExactBody&, double spacing, const Vec3& offset);

struct SurfaceErrors {
  double volume = 0.0, area = 0.0;  ///< over the exact value, minus 1
  double hausdorff = 0.0;           ///< the greatest distance of one surface from the other, either way [m]
};
[[nodiscard]] SurfaceErrors errors_of(const Mesh&, const ExactBody&, double spacing);
/// Root mean square over the body's offsets, with the lengths of for_spacing. @param detector whether f is
/// that of (25), else 1
[[nodiscard]] SurfaceErrors errors_at(const ExactBody&, double spacing, bool detector = true);

}  // namespace tripoint::shapes
