// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/quaternion.hpp"
#include "scene/geometry.hpp"

namespace tripoint {
namespace {

using Drawn = Shape::Kind;

constexpr double half = 0.5 * layer_depth;
constexpr double rounding = 1e-9;  ///< [1]

[[noreturn]] void refuse(const SourcePlace& place, const std::string& who, const std::string& why) {
  throw InputError(place, fmt::format("{} {}: scene.dimensions = 2 has x and z alone", who, why));
}

void in_plane(const SourcePlace& place, const std::string& who, const Vec3& v, const char* what) {
  if (v.y != 0.0) refuse(place, who, fmt::format("has a {} along y", what));
}

void about_y(const SourcePlace& place, const std::string& who, const Vec3& v, const char* what) {
  if (v.x != 0.0 || v.z != 0.0) refuse(place, who, fmt::format("has a {} about x or z", what));
}

/// A turn about y without its round-off. @throws InputError where it is about another axis
Quaternion in_plane(const Quaternion& q, const char* what) {
  if (std::abs(q.x) > rounding || std::abs(q.z) > rounding)
    throw InputError(fmt::format("{} is turned out of the plane of x and z", what));
  return normalised({q.w, 0.0, q.y, 0.0});
}

void flatten(std::vector<Keyframe>& keyframes) {
  for (Keyframe& k : keyframes) {
    k.rotation = in_plane(k.rotation, "a keyframe");
    k.position.y = 0.0;
  }
}

Shape box(const Vec3& min, const Vec3& max) {
  Shape s;
  s.kind = Drawn::box;
  s.min = {min.x, -half, min.z};
  s.max = {max.x, half, max.z};
  return s;
}

Shape disc(const Vec3& centre, double radius) {
  Shape s;
  s.kind = Drawn::cylinder;
  s.base = {centre.x, -half, centre.z};
  s.axis = {0.0, 1.0, 0.0};
  s.length = layer_depth;
  s.radius = radius;
  return s;
}

/// A cylinder along y is a disc, one in the plane a rectangle.
Shape of_cylinder(const Shape& s) {
  if (std::abs(std::abs(s.axis.y) - 1.0) <= rounding) return disc(s.base, s.radius);
  if (std::abs(s.axis.y) > rounding) throw InputError("a cylinder leans out of the plane of x and z");
  const Vec3 middle = s.base + 0.5 * s.length * s.axis, reach{0.5 * s.length, 0.0, s.radius};
  Shape rectangle = box(middle - reach, middle + reach);
  const double angle = std::atan2(-s.axis.z, s.axis.x);  // about y
  rectangle.rotation = angle == 0.0 ? Quaternion{} : from_rotation_vector({0.0, angle, 0.0});
  return rectangle;
}

/// Without the rotation of the shape itself.
Shape of_plain(const Shape& s) {
  switch (s.kind) {
    case Drawn::box:
      return box(s.min, s.max);
    case Drawn::sphere:
      return disc(s.centre, s.radius);
    case Drawn::cylinder:
      return of_cylinder(s);
    case Drawn::half_space:
      if (s.normal.y != 0.0) throw InputError("a half space has a normal along y");
      return s;
    case Drawn::unite:
    case Drawn::difference: {
      Shape all = not_turned(s);
      std::ranges::transform(s.of, all.of.begin(), planar);
      return all;
    }
    case Drawn::mesh:
      break;
  }
  throw InputError("a mesh has no form in the plane: draw it by boxes, cylinders and half spaces");
}

void flatten(Body& b) {
  const std::string who = fmt::format("body \"{}\"", b.name);
  about_y(b.place, who, b.angular_velocity, "spin");
  in_plane(b.place, who, b.velocity.value, "velocity");
  flatten(b.keyframes);
  b.shape = planar(b.shape);
}

void flatten(Event& e) {
  flatten(e.keyframes);
  if (e.region) e.region = planar(*e.region);
}

void flatten(AppliedForce& f) {
  in_plane(f.place, "a force", f.value, "part");
  about_y(f.place, "a force", f.torque, "torque");
  if (f.point) f.point->y = 0.0;
}

/// Tells where a shape stands that has no form in the plane.
template <class Owner>
void flatten_at(Owner& owner, const SourcePlace& place) {
  try {
    flatten(owner);
  } catch (const InputError& e) {
    throw e.place().line > 0 ? e : InputError(place, e.what());
  }
}

}  // namespace

Shape planar(const Shape& s) {
  Shape flat = of_plain(s);
  if (is_turned(s)) flat.rotation = in_plane(s.rotation, "a shape") * flat.rotation;
  return flat;
}

void make_planar(Scene& s) {
  for (Body& b : s.bodies) flatten_at(b, b.place);
  for (Event& e : s.events) flatten_at(e, e.place);
  for (AppliedForce& f : s.forces) flatten_at(f, f.place);
  for (HeatSource& source : s.sources)
    if (source.region) source.region = planar(*source.region);
  for (Inflow& f : s.inflows) {
    in_plane({}, "an inflow", f.velocity, "velocity");
    f.shape = planar(f.shape);
  }
  for (Outflow& f : s.outflows) f.shape = planar(f.shape);
  if (s.min) s.min->y = -half;
  if (s.max) s.max->y = half;
}

}  // namespace tripoint
