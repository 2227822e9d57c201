// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/defaults.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/meeting.hpp"

namespace tripoint {
namespace {

/// Bodies that have to do with each other, and the pairs of solids among them that can meet.
struct Neighbourhood {
  std::vector<const Body*> bodies;
  std::vector<Meeting> meetings;
};

/// Whether a body is liquid at any time.
bool can_flow(const Scene& s, const Body& b) {
  return b.phase == Phase::liquid || (s.material(b.material).t_melt && calls_for(s, "phase"));
}

/// Whether liquid of `a` can splash to `b`: as far as its body is large.
bool splashes(const Body& a, const Body& b) {
  const Bounds from = bounds(a.shape), to = bounds(b.shape);
  const Vec3 size = from.extent();
  const double reach = std::max({size.x, size.y, size.z});
  for (std::size_t k = 0; k < 3; ++k)
    if (from.max[k] + reach < to.min[k] || to.max[k] < from.min[k] - reach) return false;
  return true;
}

bool joined(const Body& a, const Body& b) {
  return std::ranges::find(a.joined_to, b.name) != a.joined_to.end();
}

/// Bodies far away, which meet none of the others and splash to none, are no reason for a stiffer contact. An
/// inflow reaches all.
std::vector<Neighbourhood> neighbourhoods(const Scene& s, const std::vector<Meeting>& meetings) {
  std::vector<std::size_t> group(s.bodies.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto unite = [&](std::size_t a, std::size_t b) {
    const std::size_t one = group[a], other = group[b];
    if (one != other) std::ranges::replace(group, std::max(one, other), std::min(one, other));
  };
  for (const Meeting& m : meetings) unite(m.a, m.b);
  for (std::size_t a = 0; a < group.size(); ++a)
    for (std::size_t b = 0; b < group.size(); ++b) {
      const Body &one = s.bodies[a], &other = s.bodies[b];
      if (group[a] == group[b]) continue;
      if (!s.inflows.empty() || joined(one, other) || (can_flow(s, one) && splashes(one, other))) unite(a, b);
    }
  std::vector<Neighbourhood> found(group.size());
  for (std::size_t n = 0; n < group.size(); ++n) found[group[n]].bodies.push_back(&s.bodies[n]);
  for (const Meeting& m : meetings) found[group[m.a]].meetings.push_back(m);
  std::erase_if(found, [](const Neighbourhood& n) { return n.bodies.empty(); });
  return found;
}

/// How far the bodies that a test picks reach along gravity [m]; 0 without gravity or such a body.
template <class Test>
double extent_along_gravity(const Scene& s, const std::vector<const Body*>& bodies, Test test) {
  const double g = norm(s.gravity);
  double least = INFINITY, most = -INFINITY;
  for (const Body* b : bodies) {
    if (!(g > 0.0) || !test(*b)) continue;
    const bool turns =
        b->shape.kind == Shape::Kind::box && is_turned(b->shape);  // its own corners, not those around it
    const Bounds box = bounds(turns ? not_turned(b->shape) : b->shape);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 r{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                   corner & 4 ? box.max.z : box.min.z};
      const double height = dot(s.gravity, turns ? turning(b->shape)(r) : r) / g;
      least = std::min(least, height);
      most = std::max(most, height);
    }
  }
  return most > least && std::isfinite(most - least) ? most - least : 0.0;
}

bool is_wet(const Body* b) { return b->phase == Phase::liquid; }

/// Greatest rest density of the bodies or, with an inflow too, of the liquids [kg/m3].
double densest(const Scene& s, const Neighbourhood& near, bool liquids) {
  double most = 0.0;
  for (const Body* b : near.bodies)
    if (!liquids || is_wet(b)) most = std::max(most, s.material(b->material).density);
  if (liquids)
    for (const Inflow& f : s.inflows) most = std::max(most, s.material(f.material).density);
  return most;
}

/// Furthest that a box reaches along a direction [m].
double depth_of(const Bounds& box, const Vec3& down) {
  double most = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
    if (down[a] != 0.0) most += std::max(down[a] * box.min[a], down[a] * box.max[a]);
  return most;
}

/// Tells of points whether they lie in shapes of a scene; of each shape it finds out once how.
class Insides {
 public:
  explicit Insides(double spacing) : spacing_(spacing) {}
  using Test = std::function<bool(const Vec3&)>;
  [[nodiscard]] const Test& of(const Shape& shape) {
    auto& test = known_[&shape];
    if (!test) test = inside_of(shape, spacing_);
    return test;
  }

 private:
  double spacing_;
  std::map<const Shape*, Test> known_;
};

/// What a shape may fall through or on: the other bodies in its way.
class Way {
 public:
  Way(const Scene& s, const Shape& falls, double density, Insides& insides) {
    const Bounds box = bounds(falls);
    const Vec3 down = (1.0 / norm(s.gravity)) * s.gravity;
    for (const Body& b : s.bodies) {
      const Bounds other = bounds(b.shape);
      if (&b.shape == &falls || !falls_onto(s, box, other)) continue;
      const double share = std::max(0.0, 1.0 - s.material(b.material).density / density);
      (is_wet(&b) ? liquids_ : solids_).push_back({&insides.of(b.shape), share});
      if (!is_wet(&b)) deepest_ = std::max(deepest_, depth_of(other, down));
    }
  }
  /// Beyond it there is no solid [m]
  [[nodiscard]] double deepest() const noexcept { return deepest_; }
  [[nodiscard]] bool is_blocked(const Vec3& r) const {
    return std::ranges::any_of(solids_, [&](const Part& p) { return (*p.inside)(r); });
  }
  /// Share of gravity that buoyancy leaves [1]
  [[nodiscard]] double weight(const Vec3& r) const {
    const auto found = std::ranges::find_if(liquids_, [&](const Part& p) { return (*p.inside)(r); });
    return found == liquids_.end() ? 1.0 : found->share;
  }

 private:
  struct Part {
    const Insides::Test* inside;
    double share;
  };
  std::vector<Part> solids_, liquids_;
  double deepest_ = -INFINITY;
};

/// How far what fills a shape can fall until it meets a solid [m], less by its buoyancy in liquid: that of
/// its parts which falls farthest, of 27. None where that is less than the support, as where it rests.
double gap_below(const Scene& s, const Shape& shape, double density, Insides& insides) {
  constexpr double most_steps = 1e4;  // of a part, wherever the floor is
  const double g = norm(s.gravity);
  if (!(g > 0.0) || !(s.spacing > 0.0)) return 0.0;
  const Vec3 down = (1.0 / g) * s.gravity;
  const double farthest = 0.5 * g * s.end_time * s.end_time;
  const auto& within = insides.of(shape);
  const Way way(s, shape, density, insides);
  const Bounds box = bounds(shape);
  double most = 0.0;
  for (int part = 0; part < 27; ++part) {
    const Vec3 share{(2 * (part % 3) + 1) / 6.0, (2 * (part / 3 % 3) + 1) / 6.0, (2 * (part / 9) + 1) / 6.0};
    Vec3 r = box.min;
    for (std::size_t a = 0; a < 3; ++a) r[a] += share[a] * box.extent()[a];
    if (!within(r)) continue;
    const double reach = std::min(way.deepest() - dot(down, r), norm(box.extent()) + farthest);
    const double step = std::max(0.5 * s.spacing, reach / most_steps);
    double passed = 0.0, gap = 0.0;
    while (passed <= reach && !way.is_blocked(r)) {
      r += step * down;
      passed += step;
      gap = within(r) ? 0.0 : gap + step * way.weight(r);
    }
    if (passed <= reach && gap < farthest) most = std::max(most, gap);
  }
  return most > s.support_ratio * s.spacing ? most : 0.0;
}

/// k that what falls asks for, free bodies and what flows in [m2/s2]: (10 v)^2, v the speed at which it meets
/// a solid, times the density over that of the liquids where it is heavier.
double stiffness_of_falls(const Scene& s, const Neighbourhood& near) {
  double most = 0.0;
  const double liquids = densest(s, near, true);
  Insides insides(s.spacing);
  const auto add = [&](const Shape& shape, double speed, double density, double extent) {
    const double gap = gap_below(s, shape, density, insides),
                 heavier = liquids > 0.0 ? density / liquids : 1.0;
    if (gap > 0.0)
      most = std::max(
          most, 100.0 * std::max(1.0, heavier) * (speed * speed + 2.0 * norm(s.gravity) * (gap + extent)));
  };
  for (const Body* b : near.bodies)
    if (b->motion == Motion::free)
      add(b->shape, greatest_speed(*b), s.material(b->material).density,
          extent_along_gravity(s, {b}, [](const Body& one) { return is_wet(&one); }));
  for (const Inflow& f : s.inflows) add(f.shape, norm(f.velocity), s.material(f.material).density, 0.0);
  return most;
}

/// k = (10 v)^2 of bodies that flow: v the greatest speed that the file tells of, or that of the liquids'
/// fall; or that of what falls on them, where it would fall farther by more than the support.
double stiffness_of_liquids(const Scene& s, const Neighbourhood& near) {
  const double g = norm(s.gravity);
  double v = 0.0;
  for (const Body* b : near.bodies) v = std::max(v, greatest_speed(*b));
  for (const Inflow& f : s.inflows) v = std::max(v, norm(f.velocity));
  const double depth = extent_along_gravity(s, near.bodies, [](const Body& b) { return is_wet(&b); });
  const double height =
      depth > 0.0 ? depth : extent_along_gravity(s, near.bodies, [](const Body&) { return true; });
  v = std::max(v, std::sqrt(2.0 * g * height));
  const double of_falls = stiffness_of_falls(s, near);
  return of_falls > 100.0 * (v * v + 2.0 * g * s.support_ratio * s.spacing) ? of_falls : 100.0 * v * v;
}

/// Whether all of it falls alike: gravity then brings no two of its bodies together.
bool falls_freely(const Scene& s, const Neighbourhood& near) {
  return s.forces.empty() &&
         std::ranges::all_of(near.bodies, [](const Body* b) { return b->motion == Motion::free; });
}

/// k of bodies that meet: (10 v)^2, or what makes the contact as stiff as the stiffest elastic body that
/// meets another (see 004).
double stiffness_of_solids(const Scene& s, const Neighbourhood& near) {
  const double g = falls_freely(s, near) ? 0.0 : norm(s.gravity);
  const double fall = 2.0 * g * extent_along_gravity(s, near.bodies, [](const Body&) { return true; });
  double speed = 0.0, modulus = 0.0;
  for (const Meeting& m : near.meetings) {
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
  return std::max(100.0 * speed * speed, modulus / densest(s, near, false));
}

/// The greatest stiffness that any neighbourhood asks for: times a rest density, it is a pressure
/// (model 8.3).
double common_stiffness(const Scene& s, const std::vector<Meeting>& meetings, bool flows) {
  const std::vector<Neighbourhood> all = neighbourhoods(s, meetings);
  const bool wet = s.has_liquid();
  double reference = 0.0, most = 0.0;
  for (const Neighbourhood& near : all) reference = std::max(reference, densest(s, near, wet));
  for (const Neighbourhood& near : all) {
    const bool flowing =
        flows && std::ranges::any_of(near.bodies, [&](const Body* b) { return can_flow(s, *b); });
    const bool liquids = std::ranges::any_of(near.bodies, is_wet) || !s.inflows.empty();
    const double k = flowing || !s.inflows.empty() ? stiffness_of_liquids(s, near)
                     : near.meetings.empty()       ? 0.0
                                                   : stiffness_of_solids(s, near);
    most = std::max(most, k * (densest(s, near, liquids) / reference));
  }
  if (most == 0.0 && flows) most = std::pow(10.0 * s.spacing / s.end_time, 2);  // liquid at rest
  return most;
}

}  // namespace

std::optional<DefaultStiffness> default_stiffness(const Scene& s) {
  if (std::ranges::any_of(s.materials, [](const Material& m) { return m.stiffness.has_value(); })) return {};
  DefaultStiffness k;
  if (calls_for(s, &EffectRule::has_pressure)) {
    k = {common_stiffness(s, s.contact ? meetings(s) : std::vector<Meeting>{}, true),
         "(10 v)^2, v the greatest of initial and prescribed speeds and sqrt(2 g times the depth of the "
         "liquids, or the fall of a body)"};
  } else if (const auto pairs = s.contact ? meetings(s) : std::vector<Meeting>{}; !pairs.empty()) {
    k = {common_stiffness(s, pairs, false),
         "solids can meet: (10 v)^2, v the greatest speed of approach with the fall by the scene's height, "
         "or the longitudinal "
         "modulus of an elastic body over the greatest density"};
  }
  if (!(k.value > 0.0) || !std::isfinite(k.value)) return {};
  return k;
}

}  // namespace tripoint
