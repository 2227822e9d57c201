// SPDX-License-Identifier: BSD-3-Clause
#include "scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <unordered_map>

#include "core/errors.hpp"
#include "foreign/confined_copy.hpp"
#include "scene/mesh_files.hpp"

namespace tripoint {
namespace {

constexpr std::size_t max_bytes = std::size_t{256} << 20, max_triangles = 5'000'000;

std::string read_bytes(const std::string& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError({file, 0, 0}, "the mesh cannot be read: " + error.message());
  if (size == 0) throw InputError({file, 0, 0}, "the mesh is empty");
  if (size > max_bytes)
    throw InputError({file, 0, 0}, fmt::format("the mesh has {} bytes; at most {} are read: simplify it", size, max_bytes));
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Exactly {
  std::size_t operator()(const Vec3& p) const noexcept {
    std::size_t h = 0;
    for (std::size_t a = 0; a < 3; ++a) h = h * 1000003U ^ std::hash<double>{}(p[a]);
    return h;
  }
};

/// STL repeats each corner for each triangle, OBJ may: equal places become one point, degenerate triangles go.
Mesh joined(const Mesh& from, double scale) {
  Mesh to;
  std::unordered_map<Vec3, std::uint32_t, Exactly> known;
  std::vector<std::uint32_t> index(from.points.size());
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const Vec3 p = scale * from.points[i] + Vec3{0.0, 0.0, 0.0};  // + 0: -0 and 0 are one place
    const auto [at, fresh] = known.try_emplace(p, static_cast<std::uint32_t>(to.points.size()));
    if (fresh) to.points.push_back(p);
    index[i] = at->second;
  }
  for (const auto& t : from.triangles) {
    const std::array<std::uint32_t, 3> joint{index[t[0]], index[t[1]], index[t[2]]};
    if (joint[0] != joint[1] && joint[1] != joint[2] && joint[2] != joint[0]) to.triangles.push_back(joint);
  }
  return to;
}

void check_numbers(const Mesh& mesh, const std::string& file) {
  if (mesh.triangles.empty()) throw InputError({file, 0, 0}, "the mesh has no triangle");
  if (mesh.triangles.size() > max_triangles)
    throw InputError({file, 0, 0}, fmt::format("the mesh has {} triangles; at most {} are read: simplify it",
                                               mesh.triangles.size(), max_triangles));
  for (const auto& p : mesh.points)
    if (!finite(p) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1e9)
      throw InputError({file, 0, 0}, fmt::format("the mesh has a corner at ({}, {}, {}): corners must be finite", p.x, p.y, p.z));
  for (const auto& t : mesh.triangles)
    for (const auto corner : t)
      if (corner >= mesh.points.size())
        throw InputError({file, 0, 0}, fmt::format("a triangle names corner {}, but there are {}", corner, mesh.points.size()));
}

}  // namespace

void check_closed(const Mesh& mesh, const std::string& file) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> uses;  // of each edge: forwards, backwards
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
    }
  std::size_t open = 0;
  std::string first;
  for (const auto& [edge, use] : uses) {
    if (use[0] == 1 && use[1] == 1) continue;
    const auto& a = mesh.points[edge.first];
    const auto& b = mesh.points[edge.second];
    if (++open <= 3)
      first += fmt::format("; ({}, {}, {}) to ({}, {}, {}) used {} and {} times", a.x, a.y, a.z, b.x, b.y, b.z, use[0], use[1]);
  }
  if (open > 0)
    throw InputError({file, 0, 0}, fmt::format("the mesh is not closed: {} open edge{} (each must be used once in each "
                                               "direction){}; fill the holes and turn all faces outward",
                                               open, open == 1 ? "" : "s", first));
}

double volume(const Mesh& mesh) {
  double six = 0.0;
  const Vec3 o = mesh.points.empty() ? Vec3{} : mesh.points.front();  // less cancellation far from the origin
  for (const auto& t : mesh.triangles) six += dot(mesh.points[t[0]] - o, cross(mesh.points[t[1]] - o, mesh.points[t[2]] - o));
  return six / 6.0;
}

namespace {

constexpr double parse_limit = 30.0;  // [s]

template <class T>
void append(std::string& bytes, const std::vector<T>& from) {
  bytes.append(reinterpret_cast<const char*>(from.data()), from.size() * sizeof(T));
}

/// The data that the copy handed back: the number of points, the points, the triangles. The caller checks their numbers.
Mesh unpacked(const std::string& bytes) {
  Mesh mesh;
  std::uint64_t points = 0;
  const std::size_t left = bytes.size() - std::min(bytes.size(), sizeof points);
  if (left > 0) std::memcpy(&points, bytes.data(), sizeof points);
  if (points > left / sizeof(Vec3)) return {};
  const char* at = bytes.data() + sizeof points;
  mesh.points.resize(points);
  if (points > 0) std::memcpy(mesh.points.data(), at, points * sizeof(Vec3));
  at += points * sizeof(Vec3);
  mesh.triangles.resize((left - points * sizeof(Vec3)) / sizeof mesh.triangles[0]);
  if (!mesh.triangles.empty()) std::memcpy(mesh.triangles.data(), at, mesh.triangles.size() * sizeof mesh.triangles[0]);
  return mesh;
}

/// Points and triangles as the file has them, read by a confined copy of us. @throws InputError
Mesh parse(const std::string& bytes, const std::string& ending, const std::string& file) {
  const CopyBounds bounds{file, parse_limit};
  const CopyEnd end = read_in_confined_copy(
      [&] {
        const Mesh mesh = ending == ".obj" ? parse_obj(bytes, file) : parse_stl(bytes, file);
        const std::uint64_t points = mesh.points.size();
        std::string packed(reinterpret_cast<const char*>(&points), sizeof points);
        append(packed, mesh.points);
        append(packed, mesh.triangles);
        return packed;
      },
      bounds);
  rethrow(end);
  if (const auto failure = failure_of(end, bounds); !failure.empty()) throw InputError(failure + ": simplify the mesh");
  return unpacked(end.bytes);
}

}  // namespace

Mesh read_mesh(const std::string& file, double scale) {
  auto ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".obj" && ending != ".stl") throw InputError({file, 0, 0}, "a mesh is a .obj or .stl file");
  const auto bytes = read_bytes(file);
  Mesh mesh = parse(bytes, ending, file);
  check_numbers(mesh, file);
  mesh = joined(mesh, scale);
  check_closed(mesh, file);
  if (volume(mesh) < 0.0) throw InputError({file, 0, 0}, "the mesh's faces turn inward: flip them");
  return mesh;
}

}  // namespace tripoint
