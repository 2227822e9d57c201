// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/errors.hpp"
#include "scene/mesh_files.hpp"
#include "scene/nearest.hpp"

namespace tripoint {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

void add(Mesh& mesh, const Vec3& corner) {
  mesh.points.push_back(corner);
  if (mesh.points.size() % 3 != 0) return;
  const auto n = static_cast<std::uint32_t>(mesh.points.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

/// 80 bytes of header, a count, and for each triangle 12 floats (normal, three corners) and 2 bytes.
Mesh binary(const std::string& bytes, std::uint32_t count, const std::string& file) {
  Mesh mesh;
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float xyz[3];
      std::memcpy(xyz, bytes.data() + 84 + std::size_t{50} * t + 12 * (corner + 1), sizeof xyz);
      if (!std::isfinite(xyz[0] + xyz[1] + xyz[2]))
        throw InputError({file, 0, 0}, fmt::format("corner {} of triangle {} is at ({}, {}, {}): write finite numbers",
                                                   corner + 1, t + 1, xyz[0], xyz[1], xyz[2]));
      add(mesh, {xyz[0], xyz[1], xyz[2]});
    }
  return mesh;
}

Mesh ascii(const std::string& bytes, const std::string& file) {
  Mesh mesh;
  std::istringstream in(bytes);
  std::string line, word;
  for (int n = 1; std::getline(in, line); ++n) {
    std::istringstream words(line);
    if (!(words >> word) || word != "vertex") continue;
    Vec3 p;
    std::string rest;
    if (!(words >> p.x >> p.y >> p.z) || !finite(p) || words >> rest)
      throw InputError({file, n, 0}, "a vertex needs three finite numbers and nothing else: \"" + printable(line) + "\"");
    add(mesh, p);
  }
  if (mesh.points.size() % 3 != 0)
    throw InputError({file, 0, 0}, fmt::format("{} vertices make no whole triangles: the file is cut", mesh.points.size()));
  return mesh;
}

}  // namespace

Mesh parse_stl(const std::string& bytes, const std::string& file) {
  std::uint32_t count = 0;
  if (bytes.size() >= 84) {
    std::memcpy(&count, bytes.data() + 80, 4);
    if (bytes.size() == 84 + std::size_t{50} * count) return binary(bytes, count, file);
  }
  if (bytes.rfind("solid", 0) == 0 && bytes.find("facet") != std::string::npos) return ascii(bytes, file);
  throw InputError({file, 0, 0}, bytes.size() < 84
                                     ? std::string("no STL: shorter than its header")
                                     : fmt::format("no whole binary STL: {} triangles need {} bytes, the file has {}", count,
                                                   84 + std::size_t{50} * count, bytes.size()));
}

}  // namespace tripoint
