// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace tripoint {

/// The surface of one body or one liquid, with what its corners know of the particles around them.
struct SurfacePart {
  std::string name;                 ///< as "body 3", "liquid water"
  Mesh mesh;                        ///< [m]
  std::vector<double> temperature;  ///< of each corner [K]; empty where the run has none
  /// Of each corner: 0 liquid, 1 elastic, 2 rigid; row of the body, -1 for a liquid
  std::vector<int> phase, body;
};

/// One binary PLY file of all parts. Columns: x y z as doubles, temperature (NaN where there is none), phase,
/// body, and part, the number of the part.
/// @throws EngineError when it cannot be written
void write_ply(const std::string& path, const std::vector<SurfacePart>&);
/// One OBJ file, an object a part. OBJ has no place for values of corners: they are in PLY alone.
/// @throws EngineError when it cannot be written
void write_obj(const std::string& path, const std::vector<SurfacePart>&);

}  // namespace tripoint
