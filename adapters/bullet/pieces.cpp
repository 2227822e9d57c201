// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/pieces.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/mesh.hpp"
#include "scene/geometry.hpp"

namespace tripoint::bullet {
namespace {

/// Whether no corner lies before any face by more than rounding.
bool convex(const Mesh& mesh) {
  double size = 0.0;
  for (const Vec3& p : mesh.points) size = std::max(size, norm(p - mesh.points.front()));
  return std::ranges::all_of(mesh.triangles, [&](const auto& t) {
    const Vec3 a = mesh.points[t[0]], normal = cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a);
    return std::ranges::all_of(
        mesh.points, [&](const Vec3& p) { return dot(normal, p - a) <= 1e-9 * size * norm(normal); });
  });
}

std::vector<Piece> mesh_pieces(const Shape& shape, const PlaceOfShape& place) {
  const Mesh mesh = read_mesh(shape.file, shape.scale);
  const bool hull = convex(mesh);
  if (!hull && place.free) return {};
  Piece piece{hull ? Piece::Kind::hull : Piece::Kind::surface, {}, {}, {}, mesh.points, mesh.triangles};
  for (Vec3& corner : piece.corners) corner = rotate_back(place.axes, corner - place.centre);
  return {piece};
}

/// The cylinder, or the capsule around it; its own axis is z, of which either end is up.
Piece rod(Piece::Kind kind, const Shape& shape, const PlaceOfShape& place) {
  const Vec3 middle = shape.base + 0.5 * shape.length * shape.axis;
  const Vec3 up = shape.axis.z < 0.0 ? -1.0 * shape.axis : shape.axis;
  const Quaternion from_z = normalised({1.0 + up.z, -up.y, up.x, 0.0});
  return {kind, rotate_back(place.axes, middle - place.centre), conjugate(place.axes) * from_z,
          Vec3{shape.radius, shape.radius, 0.5 * shape.length}};
}

/// The cylinder of a union that is a capsule: balls of its radius lie at both ends of its axis.
const Shape* capsule_in(const std::vector<Shape>& parts) {
  const auto is_rod = [](const Shape& part) {
    return part.kind == Shape::Kind::cylinder && !is_turned(part);
  };
  const auto found = std::ranges::find_if(parts, is_rod);
  if (parts.size() != 3 || found == parts.end()) return nullptr;
  const double size = 1e-9 * found->radius;
  const Vec3 end = found->base + found->length * found->axis;
  const auto has_ball = [&](const Vec3& at) {
    return std::ranges::any_of(parts, [&](const Shape& ball) {
      return ball.kind == Shape::Kind::sphere && std::abs(ball.radius - found->radius) <= size &&
             norm(ball.centre - at) <= size;
    });
  };
  return has_ball(found->base) && has_ball(end) ? &*found : nullptr;
}

std::vector<Piece> pieces_of_parts(const std::vector<Shape>& parts, const PlaceOfShape& place) {
  if (const Shape* capsule = capsule_in(parts)) return {rod(Piece::Kind::capsule, *capsule, place)};
  std::vector<Piece> all;
  for (const Shape& part : parts) {
    const auto own = pieces_of(part, place);
    if (own.empty()) return {};
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

/// The body's place and axes as they are before the shape is turned.
PlaceOfShape before_turning(const Shape& shape, PlaceOfShape place) {
  const Vec3 centre = turning_centre(shape);
  place.centre = centre + rotate_back(shape.rotation, place.centre - centre);
  place.axes = conjugate(shape.rotation) * place.axes;
  return place;
}

}  // namespace

std::vector<Piece> pieces_of(const Shape& shape, const PlaceOfShape& place) {
  if (is_turned(shape)) return pieces_of(not_turned(shape), before_turning(shape, place));
  const auto local = [&](const Vec3& x) { return rotate_back(place.axes, x - place.centre); };
  switch (shape.kind) {
    case Shape::Kind::box:
      return {{Piece::Kind::box, local(0.5 * (shape.min + shape.max)), conjugate(place.axes),
               0.5 * (shape.max - shape.min)}};
    case Shape::Kind::sphere:
      return {{Piece::Kind::sphere, local(shape.centre), {}, Vec3{shape.radius, shape.radius, shape.radius}}};
    case Shape::Kind::cylinder:
      return {rod(Piece::Kind::cylinder, shape, place)};
    case Shape::Kind::unite:
      return pieces_of_parts(shape.of, place);
    case Shape::Kind::mesh:
      return mesh_pieces(shape, place);
    default:
      return {};
  }
}

}  // namespace tripoint::bullet
