// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/shape_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "mesh/mesh.hpp"
#include "sampling/sample.hpp"
#include "scene/geometry.hpp"

namespace tripoint {
namespace {

using Kind = Shape::Kind;

double to_box(const Shape& s, const Vec3& r) {
  double inside = -std::numeric_limits<double>::infinity();
  Vec3 beyond;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = std::max(s.min[a] - r[a], r[a] - s.max[a]);
    inside = std::max(inside, d);
    beyond[a] = std::max(d, 0.0);
  }
  return inside > 0.0 ? norm(beyond) : inside;
}

double to_cylinder(const Shape& s, const Vec3& r) {
  const Vec3 d = r - s.base;
  const double along = dot(d, s.axis), ends = std::max(-along, along - s.length),
               side = norm(d - along * s.axis) - s.radius;
  return ends > 0.0 && side > 0.0 ? std::hypot(ends, side) : std::max(ends, side);
}

std::vector<PlaceFunction> parts_of(const Shape& s, double spacing) {
  std::vector<PlaceFunction> parts;
  for (const Shape& part : s.of) parts.push_back(distance_of(part, spacing));
  return parts;
}

/// Moments of inertia about the centre along the shape's own axes, of unit density [m5].
struct Filled {
  double volume = 0.0;
  Vec3 centre, moments;
};

std::optional<Filled> by_formula(const Shape& s) {
  const double V = volume(s).value_or(0.0);
  if (s.kind == Kind::box) {
    const Vec3 L = s.max - s.min;
    return Filled{V, 0.5 * (s.min + s.max),
                  V / 12.0 * Vec3{L.y * L.y + L.z * L.z, L.z * L.z + L.x * L.x, L.x * L.x + L.y * L.y}};
  }
  if (s.kind == Kind::sphere) return Filled{V, s.centre, 0.4 * V * s.radius * s.radius * Vec3{1, 1, 1}};
  if (s.kind != Kind::cylinder) return {};
  const double along = 0.5 * V * s.radius * s.radius,
               across = V * (3.0 * s.radius * s.radius + s.length * s.length) / 12.0;
  return Filled{V, s.base + 0.5 * s.length * s.axis, {along, across, across}};
}

// Of a sum over a shape's bounds; its error is of second order in their size
constexpr double cells_across = 64.0;

/// The sum over cells, each with its filled share at its centre; in the plane over one layer of them.
MassProperties by_cells(const Shape& s, double density, double spacing, Bounds b, Dimensions d) {
  Vec3 L = b.extent();
  if (d == Dimensions::two) L.y = 0.0;
  double side = std::max({L.x, L.y, L.z}) / cells_across;
  if (d == Dimensions::two) side = std::min(side, layer_depth);
  if (d == Dimensions::two) b.min.y = -0.5 * side;
  const auto count = [&](double length) {
    return std::max(1L, static_cast<long>(std::ceil(length / side - 1e-9)));
  };
  const auto share = filled_share(s, side, spacing);
  std::vector<Vec3> place;
  std::vector<double> mass;
  for (long i = 0; i < count(L.x); ++i)
    for (long j = 0; j < count(L.y); ++j)
      for (long k = 0; k < count(L.z); ++k) {
        const Vec3 r = b.min + side * Vec3{double(i) + 0.5, double(j) + 0.5, double(k) + 0.5};
        const double filled = share(r);
        if (!(filled > 0.0)) continue;
        place.push_back(r);
        mass.push_back(filled * density * cell_volume(side, d));
      }
  return mass_properties(place, mass);
}

/// A function of the shape that is not turned, at the places of the turned one.
PlaceFunction turned(const Shape& s, PlaceFunction upright) {
  return [upright = std::move(upright), q = s.rotation, centre = turning_centre(s)](const Vec3& r) {
    return upright(centre + rotate_back(q, r - centre));
  };
}

}  // namespace

PlaceFunction distance_of(const Shape& s, double spacing) {
  if (is_turned(s)) return turned(s, distance_of(not_turned(s), spacing));
  switch (s.kind) {
    case Kind::box:
      return [s](const Vec3& r) { return to_box(s, r); };
    case Kind::sphere:
      return [s](const Vec3& r) { return norm(r - s.centre) - s.radius; };
    case Kind::cylinder:
      return [s](const Vec3& r) { return to_cylinder(s, r); };
    case Kind::half_space:
      return [s](const Vec3& r) { return dot(r - s.point, s.normal); };
    case Kind::unite:
      return [parts = parts_of(s, spacing)](const Vec3& r) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& part : parts) least = std::min(least, part(r));
        return least;
      };
    case Kind::difference:
      return [parts = parts_of(s, spacing)](const Vec3& r) { return std::max(parts[0](r), -parts[1](r)); };
    case Kind::mesh:
      return [interior = std::make_shared<MeshInterior>(read_mesh(s.file, s.scale), 0.5 * spacing, s.file)](
                 const Vec3& r) { return interior->distance(r); };
  }
  return {};
}

PlaceFunction filled_share(const Shape& s, double side, double spacing) {
  if (is_turned(s)) return turned(s, filled_share(not_turned(s), side, spacing));
  if (s.kind != Kind::unite && s.kind != Kind::difference)
    return [d = distance_of(s, spacing), side](const Vec3& r) {
      return std::clamp(0.5 - d(r) / side, 0.0, 1.0);
    };
  std::vector<PlaceFunction> parts;
  for (const Shape& part : s.of) parts.push_back(filled_share(part, side, spacing));
  if (s.kind == Kind::difference)
    return [parts](const Vec3& r) { return std::max(0.0, parts[0](r) - parts[1](r)); };
  return [parts](const Vec3& r) {  // parts that touch fill a cell together
    double sum = 0.0;
    for (const auto& part : parts) sum += part(r);
    return std::min(1.0, sum);
  };
}

std::optional<MassProperties> mass_of_shape(const Shape& s, double density, double spacing, Dimensions d) {
  if (d == Dimensions::two) {
    const Bounds b = bounds(s);
    if (!finite(b.min) || !finite(b.max)) return {};
    return by_cells(s, density, spacing, b, d);
  }
  if (is_turned(s)) {
    auto p = mass_of_shape(not_turned(s), density, spacing);
    if (!p) return p;
    p->centre = turning(s)(p->centre);
    p->principal_axes = s.rotation * p->principal_axes;
    return p;
  }
  if (const auto exact = by_formula(s)) {
    MassProperties p;
    p.mass = density * exact->volume;
    p.centre = exact->centre;
    p.principal_inertia = density * exact->moments;
    auto& I = p.principal_inertia;
    if (I.x > I.y) std::swap(I.x, I.y);
    if (I.y > I.z) std::swap(I.y, I.z);
    if (I.x > I.y) std::swap(I.x, I.y);
    return p;
  }
  const Bounds b = bounds(s);
  if (!finite(b.min) || !finite(b.max)) return {};
  if (s.kind == Kind::mesh) return mass_properties(read_mesh(s.file, s.scale), density);
  return by_cells(s, density, spacing, b, d);
}

}  // namespace tripoint
