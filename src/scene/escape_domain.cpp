// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "scene/meeting.hpp"
#include "scene/motion.hpp"

namespace tripoint {
namespace {

Bounds nothing() { return {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}; }

void include(Bounds& box, const Vec3& r) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.min[a] = std::min(box.min[a], r[a]);
    box.max[a] = std::max(box.max[a], r[a]);
  }
}

/// The box at another place, and larger by `by` on each side.
void include(Bounds& box, const Bounds& part, const Vec3& shift, double by) {
  const Vec3 room{by, by, by};
  include(box, part.min + shift - room);
  include(box, part.max + shift + room);
}

/// Boxes around the particles of each body.
std::vector<Bounds> boxes_of(const Scene& s, const InitialState& initial) {
  std::vector<Bounds> boxes(s.bodies.size(), nothing());
  for (std::size_t i = 0; i < initial.size(); ++i)
    include(boxes.at(static_cast<std::size_t>(initial.source[i])), initial.position[i]);
  return boxes;
}

/// Furthest that a box reaches along gravity.
double depth(const Scene& s, const Bounds& box) {
  double most = -INFINITY;
  for (int n = 0; n < 8; ++n)
    most = std::max(most, dot(s.gravity, Vec3{n & 1 ? box.max.x : box.min.x, n & 2 ? box.max.y : box.min.y,
                                              n & 4 ? box.max.z : box.min.z}));
  return most;
}

}  // namespace

bool falls_onto(const Scene& s, const Bounds& box, const Bounds& wall) {
  Bounds way = box;
  include(way, box, 0.5 * s.end_time * s.end_time * s.gravity, 0.0);
  for (std::size_t a = 0; a < 3; ++a)
    if (way.max[a] < wall.min[a] || wall.max[a] < way.min[a]) return false;
  return true;
}

namespace {

bool has_wall_below(const Scene& s, const std::vector<Bounds>& boxes, const Bounds& box) {
  for (std::size_t n = 0; n < s.bodies.size(); ++n)
    if (s.bodies[n].motion != Motion::free && depth(s, boxes[n]) > depth(s, box) &&
        falls_onto(s, box, boxes[n]))
      return true;
  return false;
}

/// Where a body that forces move can be at the end, and where its flight turns.
void include_flight(Bounds& all, double end, const Bounds& box, const Vec3& velocity, double spread,
                    const Vec3& g) {
  include(all, box, end * velocity + 0.5 * end * end * g, spread * end);
  for (std::size_t a = 0; a < 3; ++a) {
    const double t = g[a] != 0.0 ? -velocity[a] / g[a] : 0.0;
    if (t > 0.0 && t < end) include(all, box, t * velocity + 0.5 * t * t * g, spread * t);
  }
}

/// That the forces on a body give it [m/s2].
Vec3 applied_acceleration(const Scene& s, const InitialState& initial, std::size_t body) {
  Vec3 force;
  for (const AppliedForce& f : s.forces)
    if (f.body == s.bodies[body].name) force += f.value;
  if (force == Vec3{}) return force;
  double mass = 0.0;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (static_cast<std::size_t>(initial.source[i]) == body) mass += initial.mass[i];
  return force / mass;
}

void include_driven(Bounds& all, const Scene& s, const Body& b, const Bounds& box) {
  const double turning = 0.5 * norm(box.extent());
  for (const Keyframe& k : b.keyframes) include(all, {k.position, k.position}, {}, turning);
  if (b.motion == Motion::prescribed && b.keyframes.empty())
    include(all, box, s.end_time * b.velocity.value, turning);
}

/// All particles, where liquid flows in, and points of joints: bodies swing about them.
Bounds start_of(const Scene& s, const InitialState& initial) {
  Bounds start = nothing();
  for (const Vec3& r : initial.position) include(start, r);
  for (const Inflow& f : s.inflows) include(start, bounds(f.shape), {}, 0.0);
  for (const Joint& j : s.joints) include(start, j.other_point.value_or(j.point));
  return start;
}

}  // namespace

Bounds escape_domain(const Scene& s, const InitialState& initial) {
  const Bounds start = start_of(s, initial);
  const double room = 2.0 * std::max(norm(start.extent()), 10.0 * s.spacing);
  Bounds all = nothing();
  include(all, start, {}, 0.0);
  const auto boxes = boxes_of(s, initial);
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    if (!(boxes[n].min.x <= boxes[n].max.x)) continue;
    include_driven(all, s, b, boxes[n]);
    if (b.motion == Motion::fixed && s.events.empty()) continue;
    const bool uniform = b.velocity.kind == VelocityField::Kind::constant &&
                         (b.phase != Phase::liquid || b.angular_velocity == Vec3{});
    include_flight(
        all, s.end_time, boxes[n], uniform ? b.velocity.value : Vec3{}, uniform ? 0.0 : greatest_speed(b),
        (has_wall_below(s, boxes, boxes[n]) ? Vec3{} : s.gravity) + applied_acceleration(s, initial, n));
  }
  for (const Inflow& f : s.inflows)
    include_flight(all, s.end_time, bounds(f.shape), f.velocity, 0.0,
                   has_wall_below(s, boxes, bounds(f.shape)) ? Vec3{} : s.gravity);
  for (const Event& e : s.events)
    for (const Keyframe& k : e.keyframes) include(all, start, k.position - e.keyframes.front().position, 0.0);
  const Vec3 around{room, room, room};
  return {all.min - around, all.max + around};
}

}  // namespace tripoint
