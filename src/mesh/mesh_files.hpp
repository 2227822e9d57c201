// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "mesh/mesh.hpp"

namespace tripoint {

/// Triangles as written, corners not joined. Polygons of an OBJ become fans. @throws InputError naming the
/// file (and line)
[[nodiscard]] Mesh parse_obj(const std::string& bytes, const std::string& file);
[[nodiscard]] Mesh parse_stl(const std::string& bytes, const std::string& file);

}  // namespace tripoint
