// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "scene/geometry.hpp"
#include "scene/read_case.hpp"

namespace tripoint {
namespace {

/// Greatest speed that the body starts with or is driven at, as far as the file tells without sampling [m/s].
double speed_of(const Body& b) {
  const VelocityField& f = b.velocity;
  double v = 0.0;
  switch (f.kind) {
    case VelocityField::Kind::constant: v = norm(f.value); break;
    case VelocityField::Kind::cosine: v = norm(f.mean) + norm(f.amplitude); break;
    case VelocityField::Kind::taylor_green: v = f.speed; break;
    case VelocityField::Kind::linear: {
      const Bounds box = bounds(b.shape);
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 r{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z};
        const Vec3 d = r - f.centre;
        v = std::max(v, norm(Vec3{dot(f.gradient[0], d), dot(f.gradient[1], d), dot(f.gradient[2], d)}));
      }
      break;
    }
    case VelocityField::Kind::expression: break;
  }
  if (b.angular_velocity != Vec3{}) v += norm(b.angular_velocity) * 0.5 * norm(bounds(b.shape).extent());
  for (std::size_t k = 1; k < b.keyframes.size(); ++k) {
    const double time = b.keyframes[k].time - b.keyframes[k - 1].time;
    if (time > 0.0) v = std::max(v, norm(b.keyframes[k].position - b.keyframes[k - 1].position) / time);
  }
  return v;
}

/// How far the liquids reach along gravity [m].
double depth_of(const Scene& s) {
  const double g = norm(s.gravity);
  double least = INFINITY, most = -INFINITY;
  for (const Body& b : s.bodies) {
    if (b.phase != Phase::liquid) continue;
    const Bounds box = bounds(b.shape);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 r{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z};
      const double height = dot(s.gravity, r) / g;
      least = std::min(least, height), most = std::max(most, height);
    }
  }
  return most - least;
}

}  // namespace

std::optional<double> default_stiffness(const Scene& s) {
  const bool given = std::any_of(s.materials.begin(), s.materials.end(), [](const Material& m) { return m.stiffness.has_value(); });
  const bool flows = std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.phase == Phase::liquid && b.motion != Motion::fixed; });
  if (given || !flows) return {};
  double v = 0.0;
  for (const Body& b : s.bodies) v = std::max(v, speed_of(b));
  for (const Inflow& f : s.inflows) v = std::max(v, norm(f.velocity));
  const double depth = norm(s.gravity) > 0.0 ? depth_of(s) : 0.0;
  if (std::isfinite(depth)) v = std::max(v, std::sqrt(2.0 * norm(s.gravity) * depth));
  if (!(v > 0.0) || !std::isfinite(v)) return {};
  return 100.0 * v * v;
}

}  // namespace tripoint
