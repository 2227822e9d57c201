// SPDX-License-Identifier: BSD-3-Clause
#include "surface/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/not_a_number.hpp"
#include "scene/initial_state.hpp"
#include "surface/mesher_module.hpp"

namespace tripoint {
namespace {

constexpr int block = tripoint_mesher_block;
constexpr std::size_t block_points = std::size_t{block} * block * block;

/// Points of the grid that phi is taken at, in blocks; the grid's point (0, 0, 0) is `origin`.
struct Samples {
  Vec3 origin;
  double voxel = 0.0;
  std::vector<std::uint64_t> keys;    // of the blocks, ascending
  std::vector<std::int32_t> corners;  // three a block [voxels]
  std::vector<float> values;          // [ir]

  [[nodiscard]] Vec3 place(double i, double j, double k) const { return origin + voxel * Vec3{i, j, k}; }
};

/// Blocks that hold a point within ir of a particle.
Samples blocks_of(const ImplicitSurface& surface, double voxel) {
  Samples s;
  s.voxel = voxel;
  s.origin = surface.bounds().low;
  const double ir = surface.options().influence_radius, side = block * voxel;
  CellTable known(surface.near_cells().size());
  const Box all = surface.bounds();
  for (std::size_t a = 0; a < 3; ++a)
    if (!((all.high[a] - all.low[a]) / side < CellTable::most - 8))
      throw InputError("the voxel of a mesh is too small for a surface of this size");
  for (const std::uint64_t key : surface.near_cells()) {
    const CellIndex c = CellTable::cell(key);
    const auto first = [&](std::size_t a) { return static_cast<std::int32_t>(std::floor(c[a] * ir / side)); };
    const auto last = [&](std::size_t a) {
      return static_cast<std::int32_t>(std::floor((c[a] + 1) * ir / side));
    };
    for (int i = first(0); i <= last(0); ++i)
      for (int j = first(1); j <= last(1); ++j)
        for (int k = first(2); k <= last(2); ++k)
          if (known.insert(CellTable::key({i, j, k}), 0)) s.keys.push_back(CellTable::key({i, j, k}));
  }
  std::ranges::sort(s.keys);
  for (const std::uint64_t key : s.keys)
    for (const std::int32_t part : CellTable::cell(key)) s.corners.push_back(block * part);
  return s;
}

/// phi over ir at each point, as OpenVDB reads it: far points count no more than ir.
void fill(const ImplicitSurface& surface, Samples& s, int threads) {
  s.values.resize(s.keys.size() * block_points);
#pragma omp parallel num_threads(threads)
  {
    SurfaceProbe probe(surface);
#pragma omp for schedule(dynamic, 4)
    for (std::size_t b = 0; b < s.keys.size(); ++b) {
      float* value = &s.values[b * block_points];
      const std::int32_t* corner = &s.corners[3 * b];
      for (int i = 0; i < block; ++i)
        for (int j = 0; j < block; ++j)
          for (int k = 0; k < block; ++k)
            *value++ = static_cast<float>(probe.phi(s.place(corner[0] + i, corner[1] + j, corner[2] + k)) /
                                          surface.options().influence_radius);
    }
  }
}

/// Steps of Newton's method towards phi = 0, which end where they leave half a voxel or lead no nearer.
Vec3 onto_surface(SurfaceProbe& probe, const Vec3& start, double voxel, double distance) {
  Vec3 r = start;
  double phi = probe.phi(r);
  for (int step = 0; step < 4 && std::abs(phi) > 1e-6 * distance; ++step) {
    const Vec3 g = probe.gradient(r);
    const double g2 = dot(g, g);
    if (!(g2 > 1e-4)) break;
    const Vec3 next = r - (phi / g2) * g;
    const double then = probe.phi(next);
    if (norm(next - start) > 0.5 * voxel || !(std::abs(then) < std::abs(phi))) break;
    r = next;
    phi = then;
  }
  return r;
}

/// The corner's parent in a forest of joined corners, with its path halved.
std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

Mesh surface_mesh(const ImplicitSurface& surface, double voxel, int threads) {
  if (!(voxel > 0.0)) throw InputError("the voxel of a mesh is a positive length");
  Samples s = blocks_of(surface, voxel);
  fill(surface, s, threads);
  Mesh mesh = sign_changes(s.corners, s.values, 1.0F);
  const double distance = surface.options().distance;
#pragma omp parallel num_threads(threads)
  {
    SurfaceProbe probe(surface);
#pragma omp for schedule(dynamic, 256)
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vec3 p = mesh.points[i];
      mesh.points[i] = onto_surface(probe, s.place(p.x, p.y, p.z), voxel, distance);
    }
  }
  return mesh;
}

std::vector<double> mean_at(const ImplicitSurface& surface, std::span<const Vec3> places,
                            std::span<const double> values, int threads) {
  std::vector<double> out(places.size(), not_a_number);
#pragma omp parallel num_threads(threads)
  {
    SurfaceProbe probe(surface);
#pragma omp for schedule(dynamic, 256)
    for (std::size_t i = 0; i < places.size(); ++i) {
      double sum = 0.0, weights = 0.0;
      probe.weigh(places[i], [&](std::uint32_t row, double w) {
        if (std::isfinite(values[row])) {
          sum += w * values[row];
          weights += w;
        }
      });
      if (weights > 0.0) out[i] = sum / weights;
    }
  }
  return out;
}

std::vector<int> label_at(const ImplicitSurface& surface, std::span<const Vec3> places,
                          std::span<const int> labels, int threads) {
  std::vector<int> out(places.size(), -1);
#pragma omp parallel num_threads(threads)
  {
    SurfaceProbe probe(surface);
    std::map<int, double> weight;
#pragma omp for schedule(dynamic, 256)
    for (std::size_t i = 0; i < places.size(); ++i) {
      weight.clear();
      probe.weigh(places[i], [&](std::uint32_t row, double w) { weight[labels[row]] += w; });
      double most = 0.0;
      for (const auto& [label, w] : weight)
        if (w > most) {
          most = w;
          out[i] = label;
        }
    }
  }
  return out;
}

MeshMeasures measures_of(const Mesh& mesh) {
  MeshMeasures m;
  std::vector<std::uint32_t> parent(mesh.points.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  std::vector<std::uint64_t> edges;  // the lower corner, the higher one, and whether it is used backwards
  for (const auto& t : mesh.triangles) {
    m.area += 0.5 * norm(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint64_t a = t[c], b = t[(c + 1) % 3];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b) << 1 | (a < b ? 0U : 1U));
      parent[root_of(parent, t[c])] = root_of(parent, t[(c + 1) % 3]);
    }
  }
  std::ranges::sort(edges);
  long count = 0;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end] >> 1 == edges[i] >> 1) ++end;
    const bool once_each_way = end - i == 2 && (edges[i] & 1U) == 0 && (edges[i + 1] & 1U) == 1;
    m.open_edges += once_each_way ? 0 : 1;
    ++count;
    i = end;
  }
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t c : t) used[c] = 1;
  long corners = 0;
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    corners += used[i];
    m.pieces += used[i] != 0 && root_of(parent, i) == i;
  }
  m.euler = corners - count + static_cast<long>(mesh.triangles.size());
  return m;
}

}  // namespace tripoint
