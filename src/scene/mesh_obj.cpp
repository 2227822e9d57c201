// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/errors.hpp"
#include "scene/mesh_files.hpp"
#include "scene/nearest.hpp"

namespace tripoint {
namespace {

constexpr std::size_t most_corners = 1000;  // of one face: the library's time to cut it goes by the square

bool is_number(const std::string& word) {
  double value = 0.0;
  const char* last = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), last, value);
  return error == std::errc() && stop == last && std::isfinite(value);
}

/// "7", "7/2", "7//3" or "7/2/3": whole numbers, none of them 0.
bool is_corner(const std::string& word) {
  std::istringstream parts(word);
  int number = 0;
  for (std::string part; std::getline(parts, part, '/'); ++number) {
    if (part.empty() && number == 1) continue;
    long value = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || stop != part.data() + part.size() || value == 0) return false;
  }
  return number >= 1 && number <= 3;
}

/// The library reads text that is no number as 0: corners and faces are checked before it sees them.
/// @throws InputError naming file and line
void check_lines(const std::string& bytes, const std::string& file) {
  std::istringstream in(bytes);
  std::string line, kind;
  for (int n = 1; std::getline(in, line); ++n) {
    std::istringstream words(line.substr(0, line.find('#')));
    if (!(words >> kind) || (kind != "v" && kind != "f")) continue;
    std::vector<std::string> rest;
    for (std::string word; words >> word;) rest.push_back(word);
    const bool corner = kind == "v";
    const bool good = std::all_of(rest.begin(), rest.end(), corner ? is_number : is_corner);
    if (!corner && good && rest.size() > most_corners)
      throw InputError({file, n, 0},
                       fmt::format("a face of {} corners; at most {}: cut it into triangles", rest.size(), most_corners));
    if (rest.size() < 3 || !good)
      throw InputError({file, n, 0},
                       fmt::format("\"{}\" is no {}", printable(line),
                                   corner ? "corner: write v and three finite numbers"
                                          : "face: write f and three or more numbers of corners, as 7, 7/2 or 7/2/3"));
  }
}

}  // namespace

Mesh parse_obj(const std::string& bytes, const std::string& file) {
  check_lines(bytes, file);
  tinyobj::attrib_t corners;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream in(bytes);
  if (!tinyobj::LoadObj(&corners, &shapes, &materials, &warning, &error, &in, nullptr, true))
    throw InputError({file, 0, 0}, fmt::format("no valid OBJ: {}", printable(error, 200)));
  Mesh mesh;
  for (std::size_t i = 0; i + 2 < corners.vertices.size(); i += 3)
    mesh.points.push_back({corners.vertices[i], corners.vertices[i + 1], corners.vertices[i + 2]});
  for (const auto& shape : shapes) {
    const auto& index = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
      std::array<std::uint32_t, 3> t{};
      for (std::size_t c = 0; c < 3; ++c) {
        const int v = index[i + c].vertex_index;
        if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
          throw InputError({file, 0, 0}, fmt::format("a face names corner {}, but there are {}", v + 1, mesh.points.size()));
        t[c] = static_cast<std::uint32_t>(v);
      }
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace tripoint
