// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <sstream>

#include "core/errors.hpp"
#include "scene/mesh_files.hpp"
#include "scene/nearest.hpp"

namespace tripoint {

Mesh parse_obj(const std::string& bytes, const std::string& file) {
  tinyobj::attrib_t corners;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream in(bytes);
  if (!tinyobj::LoadObj(&corners, &shapes, &materials, &warning, &error, &in, nullptr, true)) throw InputError({file, 0, 0}, fmt::format("no valid OBJ: {}", printable(error, 200)));
  Mesh mesh;
  for (std::size_t i = 0; i + 2 < corners.vertices.size(); i += 3) mesh.points.push_back({corners.vertices[i], corners.vertices[i + 1], corners.vertices[i + 2]});
  for (const auto& shape : shapes) {
    const auto& index = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
      std::array<std::uint32_t, 3> t{};
      for (std::size_t c = 0; c < 3; ++c) {
        const int v = index[i + c].vertex_index;
        if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size()) throw InputError({file, 0, 0}, fmt::format("a face names corner {}, but there are {}", v + 1, mesh.points.size()));
        t[c] = static_cast<std::uint32_t>(v);
      }
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace tripoint
