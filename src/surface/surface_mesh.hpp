// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "surface/implicit_surface.hpp"

namespace tripoint {

/// A closed triangle mesh of phi = 0. Corners where OpenVDB puts them are moved onto the surface, each by at
/// most half a voxel.
/// @param voxel distance of the points that phi is taken at [m]; features thinner than it may be lost
/// @param threads of our own part; they do not change the bits
/// @return no triangle where no point lies inside
/// @throws InputError where the voxel is not positive, or so small that the grid has more than 2^31 points
/// along an axis
/// @throws EngineError where OpenVDB cannot be loaded or fails
[[nodiscard]] Mesh surface_mesh(const ImplicitSurface&, double voxel, int threads);

/// Values of the particles around each corner of a mesh.
/// @param values by particle; those that are not finite do not count   @return their mean weighted as in
/// (24); NaN where none counts
[[nodiscard]] std::vector<double> mean_at(const ImplicitSurface&, std::span<const Vec3> places,
                                          std::span<const double> values, int threads);
/// @param labels by particle   @return the label with the greatest sum of weights, the smaller one of two
/// that are equal; -1 where none is near
[[nodiscard]] std::vector<int> label_at(const ImplicitSurface&, std::span<const Vec3> places,
                                        std::span<const int> labels, int threads);

/// Measures of a mesh that can be compared with an exact body. Its volume is that of mesh/mesh.hpp.
struct MeshMeasures {
  double area = 0.0;           ///< [m2]
  long euler = 0;              ///< corners - edges + triangles: 2 for each ball, 0 for each torus
  std::size_t pieces = 0;      ///< parts that share no corner
  std::size_t open_edges = 0;  ///< edges that are not used once in each direction
};
[[nodiscard]] MeshMeasures measures_of(const Mesh&);

}  // namespace tripoint
