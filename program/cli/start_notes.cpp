// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/start_notes.hpp"
#include "liquids/carried_density.hpp"
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tripoint {
namespace {

/// Rms speed of a lattice that is let go, over sqrt(g H): the least that was measured
constexpr double stirs = 0.03;

/// The part of gravity that no periodic direction lets through [m/s2]
Vec3 weight(const Scene& s) {
  return {s.periodic[0] ? 0.0 : s.gravity.x, s.periodic[1] ? 0.0 : s.gravity.y,
          s.periodic[2] ? 0.0 : s.gravity.z};
}

bool is_solid(const Body& b, Motion motion) { return b.phase != Phase::liquid && b.motion == motion; }

/// Depth of the liquid of this body along gravity, one spacing more than its particles lie apart [m]; 0 where
/// one of them moves.
double depth_at_rest(const Scene& s, const InitialState& state, std::size_t body, const Vec3& down) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (static_cast<std::size_t>(state.source[i]) != body) continue;
    if (norm(state.velocity[i]) > 0.0) return 0.0;
    const double z = dot(state.position[i], down);
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return high < low ? 0.0 : high - low + s.spacing;
}

const Material& material_of(const Scene& s, const Body& b) {
  return *std::ranges::find(s.materials, b.material, &Material::name);
}

}  // namespace

std::vector<Finding> start_notes(const Scene& s, const InitialState& state) {
  const double g = norm(weight(s));
  const auto any = [&](Motion motion) {
    return std::ranges::any_of(s.bodies, [&](const Body& b) { return is_solid(b, motion); });
  };
  if (s.settle || g == 0.0 || liquid::carries_density(s) || any(Motion::free) || !any(Motion::fixed))
    return {};
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    if (b.phase != Phase::liquid) continue;
    const Material& m = material_of(s, b);
    const double speed = stirs * std::sqrt(g * depth_at_rest(s, state, n, weight(s) / g));
    if (m.viscosity >= m.density * speed * s.spacing) continue;  // it is held back within about a spacing
    return {{false,
             fmt::format("liquid \"{}\" starts as a lattice, which is no equilibrium: let go, it moves at "
                         "some {:.1g} m/s rms "
                         "for seconds; where it is to be at rest, scene.settle = true lets it down first",
                         b.name, speed),
             b.place}};
  }
  return {};
}

}  // namespace tripoint
