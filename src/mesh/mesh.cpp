// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <unordered_map>

#include "core/confined_copy.hpp"
#include "core/errors.hpp"
#include "mesh/mesh_files.hpp"

namespace tripoint {
namespace {

constexpr std::size_t max_bytes = std::size_t{256} << 20, max_triangles = 5'000'000;

std::string read_bytes(const std::string& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError({file, 0, 0}, "the mesh cannot be read: " + error.message());
  if (size == 0) throw InputError({file, 0, 0}, "the mesh is empty");
  if (size > max_bytes)
    throw InputError({file, 0, 0},
                     fmt::format("the mesh has {} bytes; at most {} are read: simplify it", size, max_bytes));
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

/// The triangles over fewer points: `index` says which one stands for each. Degenerate triangles go.
std::vector<std::array<std::uint32_t, 3>> renamed(const Mesh& from, const std::vector<std::uint32_t>& index) {
  std::vector<std::array<std::uint32_t, 3>> to;
  for (const auto& t : from.triangles) {
    const std::array<std::uint32_t, 3> joint{index[t[0]], index[t[1]], index[t[2]]};
    if (joint[0] != joint[1] && joint[1] != joint[2] && joint[2] != joint[0]) to.push_back(joint);
  }
  return to;
}

/// STL repeats each corner for each triangle, OBJ may: equal places become one point.
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
  to.triangles = renamed(from, index);
  return to;
}

/// Points sorted into cells of twice the tolerance, so that most places look into one cell.
class Nearby {
 public:
  explicit Nearby(double tolerance) : tolerance_(tolerance) {}
  /// The first point within the tolerance, or this new one.
  std::uint32_t point(const Vec3& p, Mesh& mesh) {
    for (const double x : {p.x - tolerance_, p.x + tolerance_})
      for (const double y : {p.y - tolerance_, p.y + tolerance_})
        for (const double z : {p.z - tolerance_, p.z + tolerance_}) {
          const auto [from, to] = cells_.equal_range(cell({x, y, z}));
          for (auto it = from; it != to; ++it)
            if (norm(mesh.points[it->second] - p) <= tolerance_) return it->second;
        }
    const auto fresh = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(p);
    cells_.emplace(cell(p), fresh);
    return fresh;
  }

 private:
  [[nodiscard]] Vec3 cell(const Vec3& p) const {
    const double side = 2.0 * tolerance_;
    return Vec3{std::floor(p.x / side), std::floor(p.y / side), std::floor(p.z / side)} + Vec3{0.0, 0.0, 0.0};
  }
  double tolerance_;
  std::unordered_multimap<Vec3, std::uint32_t, Exactly> cells_;
};

/// Of the mesh's extent: what single precision and a CAD program leave between equal corners
constexpr double round_off = 1e-6;

/// Corners that differ by round-off become one.
Mesh welded(const Mesh& from) {
  Vec3 low = from.points.front(), high = low;
  for (const auto& p : from.points)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  Mesh to;
  Nearby nearby(round_off * norm(high - low));
  std::vector<std::uint32_t> index;
  for (const auto& p : from.points) index.push_back(nearby.point(p, to));
  to.triangles = renamed(from, index);
  return to;
}

void check_numbers(const Mesh& mesh, const std::string& file) {
  if (mesh.triangles.empty()) throw InputError({file, 0, 0}, "the mesh has no triangle");
  if (mesh.triangles.size() > max_triangles)
    throw InputError({file, 0, 0}, fmt::format("the mesh has {} triangles; at most {} are read: simplify it",
                                               mesh.triangles.size(), max_triangles));
  for (const auto& p : mesh.points)
    if (!finite(p) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1e9)
      throw InputError(
          {file, 0, 0},
          fmt::format("the mesh has a corner at ({}, {}, {}): corners must be finite", p.x, p.y, p.z));
  for (const auto& t : mesh.triangles)
    for (const auto corner : t)
      if (corner >= mesh.points.size())
        throw InputError({file, 0, 0}, fmt::format("a triangle names corner {}, but there are {}", corner,
                                                   mesh.points.size()));
}

}  // namespace

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using EdgeUses = std::map<Edge, std::array<int, 2>>;  // forwards, backwards

EdgeUses edge_uses(const Mesh& mesh) {
  EdgeUses uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
    }
  return uses;
}

bool is_closed(const Mesh& mesh) {
  return std::ranges::all_of(edge_uses(mesh),
                             [](const auto& edge) { return edge.second[0] == edge.second[1]; });
}

/// The first few edges of a kind, with their uses.
std::string some_edges(const Mesh& mesh, const EdgeUses& uses, bool (*of_kind)(const std::array<int, 2>&)) {
  std::string text;
  int reported = 0;
  for (const auto& [edge, use] : uses) {
    if (!of_kind(use) || ++reported > 3) continue;
    const auto &a = mesh.points[edge.first], &b = mesh.points[edge.second];
    text += fmt::format("; ({}, {}, {}) to ({}, {}, {}) used {} and {} times", a.x, a.y, a.z, b.x, b.y, b.z,
                        use[0], use[1]);
  }
  return text;
}

/// An edge of a hole is used by an odd number of faces; one between faces that turn against each other by an
/// even number.
bool of_hole(const std::array<int, 2>& use) { return (use[0] + use[1]) % 2 == 1; }
bool of_turned(const std::array<int, 2>& use) { return (use[0] + use[1]) % 2 == 0 && use[0] != use[1]; }

/// A face that is written twice the same way round would count twice in the volume.
void refuse_repeated_faces(const Mesh& mesh, const std::string& file) {
  auto faces = mesh.triangles;
  for (auto& t : faces) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(faces);
  const auto same = std::ranges::adjacent_find(faces);
  if (same == faces.end()) return;
  const auto& p = mesh.points[(*same)[0]];
  throw InputError({file, 0, 0},
                   fmt::format("a face at ({}, {}, {}) is written twice: remove the copies", p.x, p.y, p.z));
}

}  // namespace

void check_closed(const Mesh& mesh, const std::string& file) {
  const auto uses = edge_uses(mesh);
  const auto count = [&](bool (*of_kind)(const std::array<int, 2>&)) {
    return std::ranges::count_if(uses, [&](const auto& edge) { return of_kind(edge.second); });
  };
  const auto edges = [](long n) { return fmt::format("{} edge{}", n, n == 1 ? "" : "s"); };
  if (const long open = count(of_hole); open > 0)
    throw InputError(
        {file, 0, 0},
        fmt::format("the mesh is not closed: {} open {} (each must be used as often in one direction as "
                    "in the other){}; fill the holes",
                    open, open == 1 ? "edge" : "edges", some_edges(mesh, uses, of_hole)));
  if (const long turned = count(of_turned); turned > 0)
    throw InputError(
        {file, 0, 0},
        fmt::format(
            "some of the mesh's faces turn inward and others outward: {} between them{}; turn all outward",
            edges(turned), some_edges(mesh, uses, of_turned)));
  refuse_repeated_faces(mesh, file);
}

double volume(const Mesh& mesh) {
  double six = 0.0;
  const Vec3 o = mesh.points.empty() ? Vec3{} : mesh.points.front();  // less cancellation far from the origin
  for (const auto& t : mesh.triangles)
    six += dot(mesh.points[t[0]] - o, cross(mesh.points[t[1]] - o, mesh.points[t[2]] - o));
  return six / 6.0;
}

namespace {

constexpr double parse_limit = 30.0;  // [s]

template <class T>
void append(std::string& bytes, const std::vector<T>& from) {
  bytes.append(reinterpret_cast<const char*>(from.data()), from.size() * sizeof(T));
}

/// The data that the copy handed back: the number of points, the points, the triangles. The caller checks
/// their numbers.
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
  if (!mesh.triangles.empty())
    std::memcpy(mesh.triangles.data(), at, mesh.triangles.size() * sizeof mesh.triangles[0]);
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
  if (const auto failure = failure_of(end, bounds); !failure.empty())
    throw InputError(failure + ": simplify the mesh");
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
  if (mesh.triangles.empty())
    throw InputError({file, 0, 0}, "all of the mesh's triangles are lines or points");
  if (!is_closed(mesh)) mesh = welded(mesh);
  check_closed(mesh, file);
  if (volume(mesh) < 0.0) throw InputError({file, 0, 0}, "the mesh's faces turn inward: flip them");
  return mesh;
}

}  // namespace tripoint
