// SPDX-License-Identifier: BSD-3-Clause
#include "scene/meeting.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/joints.hpp"
#include "scene/motion.hpp"
#include "tables/expression.hpp"

namespace tripoint {
namespace {

constexpr int slices = 64;  ///< of the run: within one all places that a body can have are one box

struct Extent {
  double low = 0.0, high = 0.0;
};
Extent operator+(Extent a, Extent b) { return {a.low + b.low, a.high + b.high}; }
Extent operator-(Extent a, Extent b) { return {a.low - b.high, a.high - b.low}; }
Extent hull(Extent a, Extent b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
/// factor >= 0
Extent scaled(Extent a, double factor) { return {factor * a.low, factor * a.high}; }
double size(Extent a) { return std::max(std::abs(a.low), std::abs(a.high)); }

using Box = std::array<Extent, 3>;
Box point(const Vec3& v) { return {Extent{v.x, v.x}, {v.y, v.y}, {v.z, v.z}}; }
Box hull(const Box& a, const Box& b) { return {hull(a[0], b[0]), hull(a[1], b[1]), hull(a[2], b[2])}; }
double size(const Box& a) { return norm(Vec3{size(a[0]), size(a[1]), size(a[2])}); }

Vec3 corner(const Bounds& box, int n) {
  return {n & 1 ? box.max.x : box.min.x, n & 2 ? box.max.y : box.min.y, n & 4 ? box.max.z : box.min.z};
}

/// Greatest speed of a field in a box, at points between whose values no smooth field of a scene hides much
/// [m/s].
double expression_speed(const std::array<std::string, 3>& text, const Bounds& box) {
  constexpr int points = 9;
  const std::array<Expression, 3> value{Expression(text[0]), Expression(text[1]), Expression(text[2])};
  double most = 0.0;
  for (int n = 0; n < points * points * points; ++n) {
    const int column = n % points, row = n / points % points, layer = n / (points * points);
    const Vec3 share{column / (points - 1.0), row / (points - 1.0), layer / (points - 1.0)};
    Vec3 r;
    for (std::size_t a = 0; a < 3; ++a) r[a] = box.min[a] + share[a] * (box.max[a] - box.min[a]);
    if (const double v = norm(Vec3{value[0](r), value[1](r), value[2](r)}); std::isfinite(v))
      most = std::max(most, v);
  }
  return most;
}

/// Where a body can be: its box at the start, moved by its known motion.
struct Path {
  Bounds box;  ///< at the start; of a body that can turn, around the sphere about its box's centre
  Box velocity, acceleration;
  std::vector<Keyframe> keyframes;  ///< places relative to the first [m]
  double spread = 0.0;              ///< speed at which its parts can leave its box [m/s]
  double rim = 0.0;                 ///< greatest speed that its spin gives a part of it [m/s]
  bool turns = false;
  bool bends = false;      ///< the body that it is joined to turns its motion into any direction
  double lost = INFINITY;  ///< time from which nothing is known of it [s]
};

bool breaks(const Body& b, const Material& m) {
  return b.phase == Phase::elastic && (m.fracture_stretch || m.fracture_distance);
}

Bounds around(const Bounds& box, double factor) {
  const Vec3 centre = 0.5 * (box.min + box.max);
  const double r = 0.5 * factor * norm(box.extent());
  return {centre - Vec3{r, r, r}, centre + Vec3{r, r, r}};
}

bool overlap(const Bounds& a, const Bounds& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.max[k] < b.min[k] || b.max[k] < a.min[k]) return false;
  return true;
}

/// How much longer a spinning elastic body becomes, with room: its strain is some (omega R/c)^2.
double stretched(const Body& b, const Material& m, const Bounds& box) {
  if (b.phase != Phase::elastic || !m.young_modulus) return 1.0;
  const double rim = norm(b.angular_velocity) * 0.5 * norm(box.extent());
  return 1.1 + rim * rim * m.density / *m.young_modulus;
}

Path own_path(const Scene& s, const Body& b) {
  Path p;
  p.box = bounds(b.shape);
  if (b.motion == Motion::fixed) return p;
  const Material& m = s.material(b.material);
  const bool free = b.motion == Motion::free, driven = !b.keyframes.empty();
  p.turns = b.angular_velocity != Vec3{} ||
            std::ranges::any_of(b.keyframes, [](const Keyframe& k) { return k.rotation != Quaternion{}; });
  p.rim = norm(b.angular_velocity) * 0.5 * norm(p.box.extent());
  if (driven) {
    p.keyframes = b.keyframes;
    for (Keyframe& k : p.keyframes) k.position -= b.keyframes.front().position;
  } else if (b.velocity.kind == VelocityField::Kind::constant) {
    p.velocity = point(b.velocity.value);
  } else {
    p.spread = greatest_speed(b);
  }
  if (free) p.acceleration = point(s.gravity);
  if (std::ranges::any_of(s.forces, [&](const AppliedForce& f) { return f.body == b.name; }) ||
      std::ranges::any_of(s.springs,
                          [&](const Spring& f) { return f.body == b.name || f.other == b.name; }) ||
      std::ranges::any_of(
          s.joints, [&](const Joint& j) { return std::ranges::find(j.bodies, b.name) != j.bodies.end(); }))
    p.lost = 0.0;
  if (free && breaks(b, m)) p.spread += p.rim;
  if (p.turns) p.box = around(p.box, stretched(b, m, p.box));
  return p;
}

/// Velocities by the segments of its keyframes, or by its start.
Box velocities_of(const Path& p) {
  Box v = p.velocity;
  for (std::size_t k = 1; k < p.keyframes.size(); ++k)
    v = hull(v, point((p.keyframes[k].position - p.keyframes[k - 1].position) /
                      (p.keyframes[k].time - p.keyframes[k - 1].time)));
  if (!p.keyframes.empty()) v = hull(v, Box{});
  return v;
}

/// Events that take a body off its path: nothing exact is asked of them.
void bend_by_events(const Scene& s, std::vector<Path>& paths) {
  for (const Event& e : s.events) {
    for (std::size_t n = 0; n < s.bodies.size(); ++n) {
      Path& p = paths[n];
      const bool named = std::ranges::find(e.bodies, s.bodies[n].name) != e.bodies.end() || e.bodies.empty();
      const bool inside = !e.region || overlap(bounds(*e.region), p.box);
      const bool grips = e.kind == Event::Kind::grip && inside,
                 merges = e.kind == Event::Kind::merge && named;
      const bool stops = (e.kind == Event::Kind::hold || e.kind == Event::Kind::release) && named;
      if (grips || merges || (stops && !p.keyframes.empty())) p.lost = std::min(p.lost, e.time);
      if (stops) {
        p.velocity = hull(p.velocity, Box{});
        p.acceleration = hull(point(s.gravity), Box{});
      }
      if (e.kind == Event::Kind::split && named) p.spread += p.rim;
    }
  }
}

/// Bodies that are joined, directly or by others, pull each other along.
void bend_by_joints(const Scene& s, std::vector<Path>& paths) {
  std::vector<std::size_t> group(paths.size());
  for (std::size_t n = 0; n < group.size(); ++n) group[n] = n;
  const auto row = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(s.bodies, name, &Body::name) - s.bodies.begin());
  };
  for (std::size_t n = 0; n < s.bodies.size(); ++n)
    for (const auto& name : s.bodies[n].joined_to) {
      const std::size_t from = group[n], to = row(name) < group.size() ? group[row(name)] : from;
      std::ranges::replace(group, std::max(from, to), std::min(from, to));
    }
  std::vector<Box> velocity(paths.size()), acceleration(paths.size());
  for (std::size_t n = 0; n < paths.size(); ++n) {
    velocity[n] = velocities_of(paths[n]);
    acceleration[n] = paths[n].acceleration;
  }
  for (std::size_t n = 0; n < paths.size(); ++n) {
    if (std::ranges::count(group, group[n]) < 2 || s.bodies[n].motion != Motion::free) continue;
    paths[n].bends = true;
    for (std::size_t m = 0; m < paths.size(); ++m) {
      if (group[m] != group[n]) continue;
      paths[n].velocity = hull(paths[n].velocity, velocity[m]);
      paths[n].acceleration = hull(paths[n].acceleration, acceleration[m]);
      paths[n].spread = std::max(paths[n].spread, paths[m].spread);
      paths[n].lost = std::min(paths[n].lost, paths[m].lost);
    }
  }
}

/// Displacements between two times by constant velocity and acceleration.
Extent moved(Extent v, Extent a, double from, double to) {
  const auto at = [&](double t) { return scaled(v, t) + scaled(a, 0.5 * t * t); };
  Extent r = hull(at(from), at(to));
  // The turning points of both edges
  for (const auto& [speed, pull] : {std::pair{v.low, a.low}, {v.high, a.high}}) {
    const double t = pull != 0.0 ? -speed / pull : -1.0;
    if (t > from && t < to) r = hull(r, {speed * t + 0.5 * pull * t * t, speed * t + 0.5 * pull * t * t});
  }
  return r;
}

Box led(const std::vector<Keyframe>& frames, double from, double to) {
  if (frames.empty()) return {};
  const auto at = [&](double t) { return point(prescribed_state(frames, {}, {}, {}, t).position); };
  Box r = hull(at(from), at(to));
  for (const Keyframe& k : frames)
    if (k.time > from && k.time < to) r = hull(r, point(k.position));
  return r;
}

/// Least distance between two boxes along an axis, the first moved by `by`, across the sides of a periodic
/// direction too.
bool near(const Scene& s, std::size_t axis, const Bounds& a, const Bounds& b, Extent by, double reach) {
  const double low = a.min[axis] + by.low - reach, high = a.max[axis] + by.high + reach;
  if (!s.periodic[axis]) return low <= b.max[axis] && high >= b.min[axis];
  const double width = (*s.max)[axis] - (*s.min)[axis];
  if (!(high - low + b.max[axis] - b.min[axis] < width)) return true;
  // The last image that begins before b ends
  const double shift = std::floor((b.max[axis] - low) / width) * width;
  return high + shift >= b.min[axis];
}

bool is_straight(const Path& p) { return p.spread == 0.0 && p.keyframes.empty() && !p.turns; }

bool meet(const Scene& s, const Path& a, const Path& b, double until) {
  if (until > a.lost || until > b.lost) return true;
  Box v, g;
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = a.velocity[k] - b.velocity[k];
    g[k] = a.acceleration[k] - b.acceleration[k];
  }
  const double spread = a.spread + b.spread;
  const bool still = size(v) == 0.0 && size(g) == 0.0 && is_straight(a) && is_straight(b);
  if (still || !(until > 0.0)) return false;
  const auto near_between = [&](double from, double to) {
    const Box by_a = led(a.keyframes, from, to), by_b = led(b.keyframes, from, to);
    const double bent = a.bends || b.bends ? size(v) * to + 0.5 * size(g) * to * to : 0.0;
    const double reach = s.spacing + spread * to + bent;
    bool all = true;
    for (std::size_t k = 0; k < 3 && all; ++k)
      all = near(s, k, a.box, b.box, moved(v[k], g[k], from, to) + by_a[k] - by_b[k], reach);
    return all;
  };
  if (!near_between(0.0, until)) return false;  // most pairs of many bodies
  for (int n = 0; n < slices; ++n)
    if (near_between(until * n / slices, until * (n + 1) / slices)) return true;
  return false;
}

bool is_joined(const Body& a, const Body& b) {
  return std::ranges::find(a.joined_to, b.name) != a.joined_to.end() ||
         std::ranges::find(b.joined_to, a.name) != b.joined_to.end();
}

/// From when on two bodies are one, or the end of the run [s].
double apart_until(const Scene& s, const Body& a, const Body& b) {
  double until = s.end_time;
  for (const Event& e : s.events) {
    const auto names = [&](const Body& body) {
      return std::ranges::find(e.bodies, body.name) != e.bodies.end();
    };
    if (e.kind == Event::Kind::merge && names(a) && names(b)) until = std::min(until, e.time);
  }
  return until;
}

bool can_be_free(const Scene& s, const Body& b) {
  if (b.motion == Motion::free) return true;
  return std::ranges::any_of(s.events, [&](const Event& e) {
    return e.kind == Event::Kind::release &&
           (e.bodies.empty() || std::ranges::find(e.bodies, b.name) != e.bodies.end());
  });
}

}  // namespace

double greatest_speed(const Body& b) {
  const VelocityField& f = b.velocity;
  double v = 0.0;
  switch (f.kind) {
    case VelocityField::Kind::constant:
      v = norm(f.value);
      break;
    case VelocityField::Kind::cosine:
      v = norm(f.mean) + norm(f.amplitude);
      break;
    case VelocityField::Kind::taylor_green:
      v = f.speed;
      break;
    case VelocityField::Kind::linear: {
      const Bounds box = bounds(b.shape);
      for (int n = 0; n < 8; ++n) {
        const Vec3 d = corner(box, n) - f.centre;
        v = std::max(v, norm(Vec3{dot(f.gradient[0], d), dot(f.gradient[1], d), dot(f.gradient[2], d)}));
      }
      break;
    }
    case VelocityField::Kind::expression:
      v = expression_speed(f.expression, bounds(b.shape));
      break;
  }
  if (b.angular_velocity != Vec3{}) v += norm(b.angular_velocity) * 0.5 * norm(bounds(b.shape).extent());
  for (std::size_t k = 1; k < b.keyframes.size(); ++k) {
    const double time = b.keyframes[k].time - b.keyframes[k - 1].time;
    if (time > 0.0) v = std::max(v, norm(b.keyframes[k].position - b.keyframes[k - 1].position) / time);
  }
  return v;
}

std::vector<Meeting> meetings(const Scene& s) {
  std::vector<Meeting> found;
  if (s.bodies.size() < 2 || std::ranges::none_of(s.bodies, [&](const Body& b) { return can_be_free(s, b); }))
    return found;
  std::vector<Path> paths;
  for (const Body& b : s.bodies) paths.push_back(own_path(s, b));
  bend_by_events(s, paths);
  bend_by_joints(s, paths);
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = i + 1; j < paths.size(); ++j) {
      const Body &a = s.bodies[i], &b = s.bodies[j];
      if ((!can_be_free(s, a) && !can_be_free(s, b)) || is_joined(a, b) || has_joint(s, a.name, b.name) ||
          !meet(s, paths[i], paths[j], apart_until(s, a, b)))
        continue;
      Box v;
      for (std::size_t k = 0; k < 3; ++k) v[k] = velocities_of(paths[i])[k] - velocities_of(paths[j])[k];
      found.push_back({i, j, size(v) + paths[i].spread + paths[j].spread + paths[i].rim + paths[j].rim});
    }
  return found;
}

}  // namespace tripoint
