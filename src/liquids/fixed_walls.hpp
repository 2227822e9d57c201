// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

/// Walls: bodies that are held or driven (model 8.4). Which scenes have them, and where the lattice of a
/// jittered one is.
namespace tripoint::liquid {

/// Whether a body is held or driven, or an event can make it so.
[[nodiscard]] inline bool can_have_walls(const Scene& scene) {
  const auto is_wall = [](const Body& b) { return b.phase != Phase::liquid && b.motion != Motion::free; };
  const auto makes_one = [](const Event& e) {
    return e.kind == Event::Kind::hold || e.kind == Event::Kind::grip;
  };
  return std::ranges::any_of(scene.bodies, is_wall) || std::ranges::any_of(scene.events, makes_one);
}

/// Whether viscous pairs see walls by the mirrored velocity (model 8.4).
[[nodiscard]] inline bool mirrors_velocities(const Scene& scene) {
  return scene.mode_of(term::walls) == Mode::corrected && can_have_walls(scene) && !carries_density(scene);
}

/// Whether every wall brakes liquid: (8) as printed does so at walls that slip too.
[[nodiscard]] inline bool all_drag(const Scene& scene) {
  return scene.mode_of(term::viscosity) == Mode::paper;
}

/// Whether liquid alone touches the walls of a scene, so that they press by the mean density of a patch of
/// their face.
[[nodiscard]] inline bool averages_walls(const Scene& scene) {
  const bool corrected =
      std::ranges::all_of(std::array{term::walls, term::density, term::pressure},
                          [&](const Term& t) { return scene.mode_of(t) == Mode::corrected; });
  const auto is_free = [](const Body& b) { return b.phase != Phase::liquid && b.motion == Motion::free; };
  return corrected && !carries_density(scene) && !calls_for(scene, "phase") &&
         std::ranges::none_of(scene.bodies, is_free);
}

/// Jitter below which the difference of two jittered places rounds to that of their lattice places
/// [spacings]. Each place is off by less than a quarter, and both together by less than a half.
inline constexpr double laid_jitter_limit = 0.25;

/// Whether the jitter of a scene leaves two particles of one lattice nearer to their own places of it than to
/// others. Fixed walls then press from their lattice. Walls that do not jitter are there already.
[[nodiscard]] inline bool has_lattice_walls(const Scene& scene) {
  const auto is_smooth = [](const Body& b) { return b.motion == Motion::fixed && !b.jitters; };
  const auto is_rough = [](const Body& b) { return b.motion == Motion::fixed && b.jitters; };
  const bool all_smooth =
      std::ranges::any_of(scene.bodies, is_smooth) && std::ranges::none_of(scene.bodies, is_rough);
  return scene.jitter > 0.0 && scene.jitter < laid_jitter_limit && !all_smooth;
}

/// Difference of two places of one lattice, from that of two that are jittered. @param away, and the result
/// [spacings]
[[nodiscard]] inline Vec3 laid(const Vec3& away) {
  return {std::round(away.x), std::round(away.y), std::round(away.z)};
}

/// A resumed run finds rows in another order, and places of walls that are off by their last bit. A millionth
/// of a spacing, or of the rest density, is far above the effect of that on a sum. It is also far below any
/// size that matters. So both runs have the same bits.
[[nodiscard]] inline double to_a_millionth(double x) {
  return std::ldexp(std::round(std::ldexp(x, 20)), -20);
}

}  // namespace tripoint::liquid
