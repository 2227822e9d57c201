// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/errors.hpp"
#include "mesh/mesh_files.hpp"
#include "tables/nearest.hpp"

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
        throw InputError({file, 0, 0},
                         fmt::format("corner {} of triangle {} is at ({}, {}, {}): write finite numbers",
                                     corner + 1, t + 1, xyz[0], xyz[1], xyz[2]));
      add(mesh, {xyz[0], xyz[1], xyz[2]});
    }
  return mesh;
}

std::string in_lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Begins with the word solid, after blanks or a mark of the byte order, and has facets. A binary header may
/// begin so too.
bool is_text(const std::string& bytes) {
  const auto first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != std::string::npos && in_lower_case(bytes.substr(first, 5)) == "solid" &&
         in_lower_case(bytes.substr(0, 4096)).find("facet") != std::string::npos &&
         bytes.find('\0') == std::string::npos;
}

Mesh ascii(const std::string& bytes, const std::string& file) {
  Mesh mesh;
  std::istringstream in(bytes);
  std::string line, word;
  for (int n = 1; std::getline(in, line); ++n) {
    std::istringstream words(line);
    if (!(words >> word) || in_lower_case(word) != "vertex") continue;
    Vec3 p;
    std::string rest;
    if (!(words >> p.x >> p.y >> p.z) || !finite(p) || words >> rest)
      throw InputError({file, n, 0},
                       "a vertex needs three finite numbers and nothing else: \"" + printable(line) + "\"");
    add(mesh, p);
  }
  if (mesh.points.size() % 3 != 0)
    throw InputError({file, 0, 0},
                     fmt::format("{} vertices make no whole triangles: the file is cut", mesh.points.size()));
  return mesh;
}

}  // namespace

Mesh parse_stl(const std::string& bytes, const std::string& file) {
  if (is_text(bytes)) return ascii(bytes, file);
  if (bytes.size() < 84)
    throw InputError(
        {file, 0, 0},
        "no STL: a text STL begins with the word solid and has facets, a binary one has 84 bytes or more");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  const std::size_t needed = 84 + std::size_t{50} * count;
  // Some programs write more behind the triangles
  if (bytes.size() >= needed) return binary(bytes, count, file);
  throw InputError(
      {file, 0, 0},
      fmt::format(
          "no whole binary STL, and no text STL either (that begins with the word solid and has facets): the "
          "count in bytes 81 to 84 is {} triangles, which need {} bytes; the file has {}",
          count, needed, bytes.size()));
}

}  // namespace tripoint
