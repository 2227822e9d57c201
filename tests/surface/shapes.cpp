// SPDX-License-Identifier: BSD-3-Clause
#include "surface/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/surface_mesh.hpp"

namespace tripoint::shapes {
namespace {

using std::numbers::pi;

/// Four ways in which a lattice happens to lie.
const std::vector<Vec3> any_lattice{{0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}, {0.21, 0.37, 0.11}, {0.68, 0.05, 0.43}};

/// n directions all over the unit sphere, by the golden angle.
std::vector<Vec3> directions(int n) {
  std::vector<Vec3> list;
  for (int k = 0; k < n; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / n, r = std::sqrt(1.0 - z * z),
                 turn = pi * (3.0 - std::sqrt(5.0)) * k;
    list.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return list;
}

/// Corners and middles of triangles.
std::vector<Vec3> places_on(const Mesh& mesh) {
  std::vector<Vec3> places = mesh.points;
  for (const auto& t : mesh.triangles)
    places.push_back((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0);
  return places;
}

}  // namespace

ExactBody ball(double radius) {
  ExactBody b{"ball",
              4.0 / 3.0 * pi * radius * radius * radius,
              4.0 * pi * radius * radius,
              radius,
              {{-radius, -radius, -radius}, {radius, radius, radius}},
              {},
              {},
              any_lattice};
  b.distance = [radius](const Vec3& r) { return norm(r) - radius; };
  for (const Vec3& n : directions(4000)) b.surface.push_back(radius * n);
  return b;
}

ExactBody torus(double ring, double tube) {
  const double out = ring + tube;
  ExactBody b{"torus",
              2.0 * pi * pi * ring * tube * tube,
              4.0 * pi * pi * ring * tube,
              tube,
              {{-out, -out, -tube}, {out, out, tube}},
              {},
              {},
              any_lattice};
  b.distance = [ring, tube](const Vec3& r) { return std::hypot(std::hypot(r.x, r.y) - ring, r.z) - tube; };
  for (int i = 0; i < 120; ++i)
    for (int j = 0; j < 40; ++j) {
      const double a = 2.0 * pi * i / 120.0, c = 2.0 * pi * j / 40.0, q = ring + tube * std::cos(c);
      b.surface.push_back({q * std::cos(a), q * std::sin(a), tube * std::sin(c)});
    }
  return b;
}

ExactBody slab(double width, double height) {
  const Vec3 half{0.5 * width, 0.5 * width, 0.5 * height};
  ExactBody b{"slab", width * width * height, 2.0 * width * width + 4.0 * width * height,
              height, {-half, half},          {},
              {},     {{0.5, 0.5, 0.5}}};
  b.distance = [half](const Vec3& r) {
    const Vec3 q{std::abs(r.x) - half.x, std::abs(r.y) - half.y, std::abs(r.z) - half.z};
    const Vec3 beyond{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return norm(beyond) + std::min(std::max({q.x, q.y, q.z}), 0.0);
  };
  constexpr int n = 24;
  for (std::size_t a = 0; a < 3; ++a)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (const double side : {-1.0, 1.0}) {
          Vec3 r;
          r[a] = side * half[a];
          r[(a + 1) % 3] = (2.0 * i / n - 1.0) * half[(a + 1) % 3];
          r[(a + 2) % 3] = (2.0 * j / n - 1.0) * half[(a + 2) % 3];
          b.surface.push_back(r);
        }
  return b;
}

std::vector<Vec3> lattice(const ExactBody& body, double spacing, const Vec3& offset) {
  std::vector<Vec3> places;
  const auto first = [&](std::size_t a) {
    return static_cast<int>(std::floor(body.box.low[a] / spacing - offset[a])) - 1;
  };
  const auto last = [&](std::size_t a) {
    return static_cast<int>(std::ceil(body.box.high[a] / spacing - offset[a])) + 1;
  };
  for (int i = first(0); i <= last(0); ++i)
    for (int j = first(1); j <= last(1); ++j)
      for (int k = first(2); k <= last(2); ++k) {
        const Vec3 r =
            spacing * (Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} + offset);
        if (body.distance(r) < 0.0) places.push_back(r);
      }
  return places;
}

SurfaceErrors errors_of(const Mesh& mesh, const ExactBody& body, double spacing) {
  SurfaceErrors e;
  e.volume = volume(mesh) / body.volume - 1.0;
  e.area = measures_of(mesh).area / body.area - 1.0;
  const auto places = places_on(mesh);
  for (const Vec3& r : places) e.hausdorff = std::max(e.hausdorff, std::abs(body.distance(r)));
  const PointCells cells(places, spacing);
  NearCache cache(cells, 3.0 * spacing);
  for (const Vec3& r : body.surface) {
    const NearPoints& near = cache.around(r);
    double least = 3.0 * spacing;
    for (std::size_t k = 0; k < near.row.size(); ++k)
      least = std::min(least, norm(Vec3{near.x[k], near.y[k], near.z[k]} - r));
    e.hausdorff = std::max(e.hausdorff, least);
  }
  return e;
}

SurfaceErrors errors_at(const ExactBody& body, double spacing, bool detector) {
  SurfaceErrors sum;
  for (const Vec3& offset : body.offsets) {
    SurfaceOptions o = SurfaceOptions::for_spacing(spacing);
    o.detector = detector;
    const SurfaceErrors e = errors_of(
        surface_mesh(ImplicitSurface(lattice(body, spacing, offset), o), 0.5 * spacing, 2), body, spacing);
    sum.volume += e.volume * e.volume;
    sum.area += e.area * e.area;
    sum.hausdorff += e.hausdorff * e.hausdorff;
  }
  const auto n = static_cast<double>(body.offsets.size());
  return {std::sqrt(sum.volume / n), std::sqrt(sum.area / n), std::sqrt(sum.hausdorff / n)};
}

}  // namespace tripoint::shapes
