// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "scene/defaults.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/meeting.hpp"

namespace tripoint {
namespace {

/// How far the bodies that a test picks reach along gravity [m]; 0 without gravity or such a body.
template <class Test>
double extent_along_gravity(const Scene& s, Test test) {
  const double g = norm(s.gravity);
  double least = INFINITY, most = -INFINITY;
  for (const Body& b : s.bodies) {
    if (!(g > 0.0) || !test(b)) continue;
    const Bounds box = bounds(b.shape);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 r{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                   corner & 4 ? box.max.z : box.min.z};
      const double height = dot(s.gravity, r) / g;
      least = std::min(least, height);
      most = std::max(most, height);
    }
  }
  return most > least && std::isfinite(most - least) ? most - least : 0.0;
}

/// k = (10 v)^2 of a scene that flows: v the greatest speed that the file tells of, or that of the liquids'
/// fall.
double stiffness_of_liquids(const Scene& s) {
  double v = 0.0;
  for (const Body& b : s.bodies) v = std::max(v, greatest_speed(b));
  for (const Inflow& f : s.inflows) v = std::max(v, norm(f.velocity));
  const double depth = extent_along_gravity(s, [](const Body& b) { return b.phase == Phase::liquid; });
  const double height = depth > 0.0 ? depth : extent_along_gravity(s, [](const Body&) { return true; });
  v = std::max(v, std::sqrt(2.0 * norm(s.gravity) * height));
  return 100.0 * v * v;
}

/// k of bodies that meet: (10 v)^2, or what makes the contact as stiff as the stiffest elastic body that
/// meets another (see 004).
double stiffness_of_solids(const Scene& s, const std::vector<Meeting>& meetings) {
  const double g = norm(s.gravity),
               fall = 2.0 * g * extent_along_gravity(s, [](const Body&) { return true; });
  double speed = 0.0, modulus = 0.0, densest = 0.0;
  for (const Body& b : s.bodies) densest = std::max(densest, s.material(b.material).density);
  for (const Meeting& m : meetings) {
    const double bounded = std::min(m.speed + g * s.end_time, std::sqrt(m.speed * m.speed + fall));
    speed = std::max(speed, bounded);
    for (const std::size_t n : {m.a, m.b}) {
      const Body& b = s.bodies[n];
      const Material& of = s.material(b.material);
      if (b.phase != Phase::elastic || b.motion != Motion::free || !of.young_modulus || !of.poisson_ratio)
        continue;
      const double nu = *of.poisson_ratio;
      modulus = std::max(modulus, *of.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)));
    }
  }
  return std::max(100.0 * speed * speed, modulus / densest);
}

}  // namespace

std::optional<DefaultStiffness> default_stiffness(const Scene& s) {
  if (std::ranges::any_of(s.materials, [](const Material& m) { return m.stiffness.has_value(); })) return {};
  DefaultStiffness k;
  if (calls_for(s, &EffectRule::has_pressure)) {
    k = {stiffness_of_liquids(s),
         "(10 v)^2, v the greatest of initial and prescribed speeds and sqrt(2 g depth of the liquids)"};
  } else if (const auto pairs = s.contact ? meetings(s) : std::vector<Meeting>{}; !pairs.empty()) {
    k = {stiffness_of_solids(s, pairs),
         "solids can meet: (10 v)^2, v the greatest speed of approach with the fall by the scene's height, "
         "or the longitudinal "
         "modulus of an elastic body over the greatest density"};
  }
  if (!(k.value > 0.0) || !std::isfinite(k.value)) return {};
  return k;
}

}  // namespace tripoint
