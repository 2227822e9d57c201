// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// A triangle mesh with shared corners; its triangles turn counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> points;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads .obj or .stl (ASCII or binary), joins equal corners, and checks that the surface is closed: every
/// edge is used as often in one direction as in the other. Where it is not, corners that differ by round-off
/// (1e-6 of the extent) are joined too. A confined copy of this process reads the file.
/// @throws InputError naming the file, and for an open mesh the number of open edges and the first of them
[[nodiscard]] Mesh read_mesh(const std::string& file, double scale);

/// @throws InputError as read_mesh
void check_closed(const Mesh&, const std::string& file);

/// Volume [m3] by the divergence theorem; negative when the triangles turn inward.
[[nodiscard]] double volume(const Mesh&);

/// Inside test by a signed distance field (OpenVDB).
class MeshInterior {
 public:
  /// @param voxel side of the field's cells [m]
  /// @throws InputError when the field has no inside at all, the sign of a mesh that leaks
  MeshInterior(const Mesh&, double voxel, const std::string& file);
  ~MeshInterior();
  [[nodiscard]] bool holds(const Vec3& r) const { return distance(r) <= 0.0; }
  /// Below zero inside, of a size of at most three voxels [m]
  [[nodiscard]] double distance(const Vec3&) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace tripoint
