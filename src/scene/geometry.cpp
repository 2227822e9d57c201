// SPDX-License-Identifier: BSD-3-Clause
#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/mesh.hpp"

namespace tripoint {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using Kind = Shape::Kind;

Bounds everything() { return {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}}; }

Bounds of_points(const std::vector<Vec3>& points) {
  Bounds b{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (const auto& p : points)
    for (std::size_t a = 0; a < 3; ++a) {
      b.min[a] = std::min(b.min[a], p[a]);
      b.max[a] = std::max(b.max[a], p[a]);
    }
  return b;
}

Bounds of_cylinder(const Shape& s) {
  const Vec3 head = s.base + s.length * s.axis;
  Bounds b = of_points({s.base, head});
  for (std::size_t a = 0; a < 3; ++a) {
    const double reach = s.radius * std::sqrt(std::max(0.0, 1.0 - s.axis[a] * s.axis[a]));
    b.min[a] -= reach;
    b.max[a] += reach;
  }
  return b;
}

/// A half space cuts a box of bounds where its normal lies along an axis.
Bounds of_half_space(const Shape& s) {
  Bounds b = everything();
  for (std::size_t a = 0; a < 3; ++a) {
    if (s.normal[a] == 1.0) b.max[a] = s.point[a];
    if (s.normal[a] == -1.0) b.min[a] = s.point[a];
  }
  return b;
}

Bounds of_union(const Shape& s) {
  Bounds b{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (const auto& part : s.of) {
    const Bounds p = bounds(part);
    for (std::size_t a = 0; a < 3; ++a) {
      b.min[a] = std::min(b.min[a], p.min[a]);
      b.max[a] = std::max(b.max[a], p.max[a]);
    }
  }
  return b;
}

/// Taking a half space away leaves what lies before its face.
Bounds of_difference(const Shape& s) {
  Bounds b = bounds(s.of[0]);
  const Shape& minus = s.of[1];
  if (minus.kind != Kind::half_space) return b;
  for (std::size_t a = 0; a < 3; ++a) {
    if (minus.normal[a] == 1.0) b.min[a] = std::max(b.min[a], minus.point[a]);
    if (minus.normal[a] == -1.0) b.max[a] = std::min(b.max[a], minus.point[a]);
  }
  return b;
}

bool in_cylinder(const Shape& s, const Vec3& r) {
  const Vec3 d = r - s.base;
  const double along = dot(d, s.axis);
  const Vec3 across = d - along * s.axis;
  return along >= 0.0 && along <= s.length && dot(across, across) <= s.radius * s.radius;
}

bool in_box(const Shape& s, const Vec3& r) {
  for (std::size_t a = 0; a < 3; ++a)
    if (r[a] < s.min[a] || r[a] > s.max[a]) return false;
  return true;
}

Vec3 middle(const Bounds& box) { return 0.5 * (box.min + box.max); }

/// Corners of the bounds of a shape that is not turned; those of a mesh itself, whose bounds they give
/// exactly.
std::vector<Vec3> corners_of(const Shape& s, const Bounds& box) {
  if (s.kind == Kind::mesh) return read_mesh(s.file, s.scale).points;
  std::vector<Vec3> corners;
  for (int n = 0; n < 8; ++n)
    corners.push_back(
        {n & 1 ? box.max.x : box.min.x, n & 2 ? box.max.y : box.min.y, n & 4 ? box.max.z : box.min.z});
  return corners;
}

Bounds bounds_of_turned(const Shape& s) {
  const Bounds box = bounds(not_turned(s));
  std::vector<Vec3> corners = corners_of(s, box);
  std::ranges::transform(corners, corners.begin(), turning(s));
  return of_points(corners);
}

}  // namespace

bool has_turned_part(const Shape& s) {
  return is_turned(s) ||
         std::any_of(s.of.begin(), s.of.end(), [](const Shape& part) { return has_turned_part(part); });
}

Shape not_turned(Shape s) {
  s.rotation = {};
  return s;
}

Vec3 turning_centre(const Shape& s) { return middle(bounds(not_turned(s))); }

std::function<Vec3(const Vec3&)> turning(const Shape& s) {
  return
      [q = s.rotation, centre = turning_centre(s)](const Vec3& r) { return centre + rotate(q, r - centre); };
}

Bounds bounds(const Shape& s) {
  if (is_turned(s)) return bounds_of_turned(s);
  switch (s.kind) {
    case Kind::box:
      return {s.min, s.max};
    case Kind::sphere:
      return {s.centre - Vec3{s.radius, s.radius, s.radius}, s.centre + Vec3{s.radius, s.radius, s.radius}};
    case Kind::cylinder:
      return of_cylinder(s);
    case Kind::half_space:
      return of_half_space(s);
    case Kind::unite:
      return of_union(s);
    case Kind::difference:
      return of_difference(s);
    case Kind::mesh:
      return of_points(read_mesh(s.file, s.scale).points);
  }
  return everything();
}

std::optional<Vec3> symmetry_centre(const Shape& s) {
  if (s.kind == Kind::sphere) return s.centre;
  if (s.kind == Kind::cylinder) return s.base + 0.5 * s.length * s.axis;
  if (s.kind == Kind::difference) return symmetry_centre(s.of[0]);
  return {};
}

std::function<bool(const Vec3&)> inside_of(const Shape& s, double spacing) {
  if (is_turned(s))
    return [inside = inside_of(not_turned(s), spacing), q = s.rotation, centre = turning_centre(s)](
               const Vec3& r) { return inside(centre + rotate_back(q, r - centre)); };
  switch (s.kind) {
    case Kind::box:
      return [s](const Vec3& r) { return in_box(s, r); };
    case Kind::sphere:
      return [s](const Vec3& r) { return dot(r - s.centre, r - s.centre) <= s.radius * s.radius; };
    case Kind::cylinder:
      return [s](const Vec3& r) { return in_cylinder(s, r); };
    case Kind::half_space:
      return [s](const Vec3& r) { return dot(r - s.point, s.normal) <= 0.0; };
    case Kind::difference: {
      auto from = inside_of(s.of[0], spacing), minus = inside_of(s.of[1], spacing);
      return [from, minus](const Vec3& r) { return from(r) && !minus(r); };
    }
    case Kind::unite: {
      std::vector<std::function<bool(const Vec3&)>> parts;
      for (const auto& part : s.of) parts.push_back(inside_of(part, spacing));
      return [parts](const Vec3& r) {
        return std::any_of(parts.begin(), parts.end(), [&](const auto& in) { return in(r); });
      };
    }
    case Kind::mesh: {
      auto interior = std::make_shared<MeshInterior>(read_mesh(s.file, s.scale), 0.5 * spacing, s.file);
      return [interior](const Vec3& r) { return interior->holds(r); };
    }
  }
  return {};
}

Vec3 put_back(const Scene& scene, Vec3 point) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!scene.periodic[a]) continue;
    const double width = (*scene.max)[a] - (*scene.min)[a];
    point[a] -= width * std::floor((point[a] - (*scene.min)[a]) / width);
  }
  return point;
}

std::function<bool(const Vec3&)> inside_region(const Scene& scene, const Shape& region) {
  auto inside = inside_of(region, scene.spacing);
  if (std::ranges::find(scene.periodic, true) == scene.periodic.end()) return inside;
  const Bounds reach = bounds(region);
  std::vector<Vec3> images{{}};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!scene.periodic[a] || !std::isfinite(reach.max[a] - reach.min[a])) continue;
    const double low = (*scene.min)[a], high = (*scene.max)[a];
    const std::size_t count = images.size();
    for (std::size_t n = 0; n < count; ++n)
      for (const int side : {-1, 1}) {
        if (side < 0 ? reach.min[a] >= low : reach.max[a] <= high) continue;
        images.push_back(images[n]);
        images.back()[a] += side * (high - low);
      }
  }
  Scene sides;  // what the function keeps: the scene may move away
  sides.min = scene.min;
  sides.max = scene.max;
  sides.periodic = scene.periodic;
  return [inside, images, sides](const Vec3& r) {
    const Vec3 within = put_back(sides, r);
    return std::ranges::any_of(images, [&](const Vec3& image) { return inside(within + image); });
  };
}

std::optional<double> volume(const Shape& s) {
  using std::numbers::pi;
  switch (s.kind) {
    case Kind::box:
      return (s.max.x - s.min.x) * (s.max.y - s.min.y) * (s.max.z - s.min.z);
    case Kind::sphere:
      return 4.0 / 3.0 * pi * s.radius * s.radius * s.radius;
    case Kind::cylinder:
      return pi * s.radius * s.radius * s.length;
    case Kind::mesh:
      return std::abs(volume(read_mesh(s.file, s.scale)));
    case Kind::half_space:
    case Kind::unite:
    case Kind::difference:
      return {};
  }
  return {};
}

}  // namespace tripoint
