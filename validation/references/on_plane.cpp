// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/on_plane.hpp"

#include <cmath>

#include "files/job.hpp"
#include "scene/geometry.hpp"
namespace tripoint {
namespace {

constexpr double round_off = 1e-9;

Vec3 unit(std::size_t axis, double sign) {
  Vec3 v;
  v[axis] = sign;
  return v;
}

Vec3 in_plane(const Vec3& v, const Vec3& up) { return v - dot(v, up) * up; }

/// Along what moves or pulls; both must be along one line.
Vec3 line_of(const Vec3& velocity, const Vec3& pull, const std::string& name) {
  if (norm(velocity) > 0.0 && norm(pull) > 0.0 &&
      norm(cross(velocity, pull)) > round_off * norm(velocity) * norm(pull))
    throw InputError(name + ": velocity and gravity along the plane are not on one line");
  if (norm(velocity) > 0.0) return velocity / norm(velocity);
  if (norm(pull) > 0.0) return pull / norm(pull);
  return {};
}

/// Half of the shape's size along a unit vector.
double half_along(const Shape& shape, const Vec3& direction) {
  if (shape.kind == Shape::Kind::sphere) return shape.radius;
  const Vec3 half = 0.5 * (shape.max - shape.min);
  return half.x * std::abs(direction.x) + half.y * std::abs(direction.y) + half.z * std::abs(direction.z);
}

Vec3 middle(const Shape& shape) {
  return shape.kind == Shape::Kind::sphere ? shape.centre : 0.5 * (shape.min + shape.max);
}

/// Axis along which a body lies on its ground and gravity presses it there: the steepest, where there are
/// more.
std::optional<std::size_t> touching_axis(const Shape& shape, const Shape& ground, const Vec3& g) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < 3; ++k) {
    if (g[k] == 0.0 || (found && std::abs(g[k]) <= std::abs(g[*found]))) continue;
    const Vec3 up = unit(k, g[k] > 0.0 ? -1.0 : 1.0);
    const double height = half_along(shape, up);
    const double gap = dot(middle(shape) - middle(ground), up) - height - half_along(ground, up);
    if (std::abs(gap) <= round_off * height) found = k;
  }
  return found;
}

}  // namespace

std::optional<double> law_of_contact(const Job& job, const std::string& name) {
  const auto at = job.settings.find(name);
  const double* const value = at == job.settings.end() ? nullptr : std::get_if<double>(&at->second);
  return value ? std::optional(*value) : std::nullopt;
}

BodyOnPlane body_on_plane(const ReferenceInput& in, const char* function) {
  const std::string name = function;
  const Vec3 g = in.job.scene.gravity;
  const auto& bodies = in.job.bodies;
  if (norm(g) == 0.0 || bodies.size() != 2)
    throw InputError(name + " holds for one free body on one that is held or moved, with gravity");
  BodyOnPlane s;
  s.body = bodies[0].motion == Motion::free ? 0 : 1;
  s.plane = 1 - s.body;
  const auto &body = bodies[s.body], &plane = bodies[s.plane];
  if (body.motion != Motion::free || plane.motion == Motion::free || !plane.keyframes.empty() ||
      norm(plane.angular_velocity) > 0.0)
    throw InputError(name +
                     " needs one free body, and one that is fixed or prescribed with a constant velocity");
  const Shape &shape = in.job.scene.body(body.name).shape, &ground = in.job.scene.body(plane.name).shape;
  s.shape = shape.kind;
  if ((!is_upright_box(shape) && shape.kind != Shape::Kind::sphere) || !is_upright_box(ground))
    throw InputError(name + " holds for a box or a ball on a box, none of them turned: turn gravity");
  const auto axis = touching_axis(shape, ground, g);
  if (!axis) throw InputError(name + ": the body must touch the plane at the start");
  s.up = unit(*axis, g[*axis] > 0.0 ? -1.0 : 1.0);
  s.height = half_along(shape, s.up);
  if (plane.motion == Motion::prescribed) s.plane_velocity = plane.velocity;
  const Vec3 relative = body.velocity - s.plane_velocity, pull = in_plane(g, s.up);
  if (std::abs(dot(relative, s.up)) > 0.0)
    throw InputError(name + ": the body leaves the plane, or is pushed by it");
  s.along = line_of(relative, pull, name);
  if (norm(s.along) == 0.0) s.along = unit((*axis + 1) % 3, 1.0);
  const Vec3 about = cross(s.up, s.along);
  s.spin = dot(body.angular_velocity, about);
  if (norm(body.angular_velocity - s.spin * about) > round_off * norm(body.angular_velocity))
    throw InputError(name + ": the body may spin about the axis that it rolls about only");
  s.half_length = half_along(shape, s.along);
  s.pull = dot(g, s.along);
  s.press = -dot(g, s.up);
  s.speed = dot(relative, s.along);
  s.friction = in.args.number("friction").value_or(law_of_contact(in.job, "friction").value_or(0.0));
  if (s.friction < 0.0) throw InputError(name + ": friction is 0 or more");
  for (const auto& b : bodies) {
    BodyState row;
    row.position = b.properties.centre;
    row.mass = b.properties.mass;
    s.start.push_back(row);
  }
  return s;
}

}  // namespace tripoint
