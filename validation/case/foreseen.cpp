// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/preflight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_set>

#include "scene/contact_law.hpp"
#include "scene/defaults.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/initial_state.hpp"
#include "scene/phase_values.hpp"
#include "scene/temperatures.hpp"

namespace tripoint {
namespace {

bool is_wall(const Body& b) { return b.phase != Phase::liquid && b.motion != Motion::free; }

/// Cells of one spacing that hold particles of walls.
class WallCells {
 public:
  WallCells(const Scene& s, const InitialState& state) : spacing_(s.spacing) {
    for (std::size_t i = 0; i < state.size(); ++i)
      if (is_wall(s.bodies[static_cast<std::size_t>(state.source[i])])) cells_.insert(key(state.position[i]));
  }
  /// Particles of the wall in one row through a place along an axis, counted up to `enough`.
  [[nodiscard]] int thickness(const Vec3& at, std::size_t axis, int enough) const {
    int count = 1;
    for (const double sign : {-1.0, 1.0}) {
      Vec3 next = at;
      for (int n = 1; n < enough; ++n) {
        next[axis] += sign * spacing_;
        if (!cells_.contains(key(next))) break;
        ++count;
      }
    }
    return count;
  }

 private:
  [[nodiscard]] std::uint64_t key(const Vec3& r) const {
    std::uint64_t k = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto cell = static_cast<std::int64_t>(std::floor(r[a] / spacing_ + 1e-6));
      k = (k << 21) ^ (static_cast<std::uint64_t>(cell) & 0x1fffffU);
    }
    return k;
  }
  double spacing_;
  std::unordered_set<std::uint64_t> cells_;
};

void thin_walls(const Scene& s, const InitialState& state, std::vector<Finding>& found) {
  const WallCells cells(s, state);
  // Liquid ends half a spacing off
  const int enough = static_cast<int>(std::ceil(s.support_ratio - 0.5 - 1e-9));
  std::map<int, std::pair<long, int>> thin;  // by body: particles, and the least layers
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Body& b = s.bodies[static_cast<std::size_t>(state.source[i])];
    if (!is_wall(b) || is_turned(b.shape)) continue;  // rows of a turned body run along no axis
    int least = enough;
    for (std::size_t a = 0; a < 3; ++a)
      if (!is_endless(s, a)) least = std::min(least, cells.thickness(state.position[i], a, enough));
    if (least >= enough) continue;
    auto& [count, layers] = thin.try_emplace(state.source[i], 0, enough).first->second;
    ++count;
    layers = std::min(layers, least);
  }
  for (const auto& [source, what] : thin) {
    const Body& b = s.bodies[static_cast<std::size_t>(source)];
    found.push_back(
        {false,
         fmt::format("body \"{}\" is {} layer{} of particles thick in places ({} of its "
                     "particles): liquid leaks through "
                     "walls that its support of {:.3g} m reaches through; make them {} layers, {:.3g} m, "
                     "or refine scene.spacing",
                     b.name, what.second, what.second == 1 ? "" : "s", what.first,
                     s.support_ratio * s.spacing, enough, enough * s.spacing),
         b.place});
  }
}

/// Whether a shape is made of boxes along the axes alone, which rows of particles can fill to their faces.
bool is_of_boxes(const Shape& shape) {
  if (is_turned(shape)) return false;
  if (shape.kind == Shape::Kind::box) return true;
  const bool made = shape.kind == Shape::Kind::unite || shape.kind == Shape::Kind::difference;
  return made && std::ranges::all_of(shape.of, is_of_boxes);
}

/// Greatest share of a spacing by which a wall's face may lie off its rows: a choice.
constexpr double face_off = 0.05;

/// Faces of the boxes of a wall, in spacings off the rows of its particles; the largest one.
struct OffRows {
  double off = 0.0, length = 0.0;
  std::size_t axis = 0;
};

/// @param wall  bounds of the wall: its rows begin at the low corner, and a cut may reach beyond the others
void look_at_faces(const Scene& s, const Shape& shape, const Bounds& wall, OffRows& worst) {
  for (const Shape& part : shape.of) look_at_faces(s, part, wall, worst);
  if (shape.kind != Shape::Kind::box) return;
  for (std::size_t a = 0; a < 3; ++a) {
    if (is_endless(s, a) || (a == 1 && s.is_planar())) continue;
    for (const double face : {shape.min[a], shape.max[a]}) {
      const double length = face - wall.min[a], rows = length / s.spacing;
      const double off = std::abs(rows - std::round(rows));
      if (length > 0.0 && face <= wall.max[a] && off > worst.off) worst = {off, length, a};
    }
  }
}

/// Liquid meets a wall where its rows end, not where its face is drawn.
void faces_off_rows(const Scene& s, std::vector<Finding>& found) {
  for (const Body& b : s.bodies) {
    if (!is_wall(b) || !is_of_boxes(b.shape)) continue;
    OffRows worst;
    look_at_faces(s, b.shape, bounds(b.shape), worst);
    if (worst.off <= face_off) continue;
    found.push_back(
        {false,
         fmt::format("body \"{}\": scene.spacing = {:g} m does not divide the {:.4g} m from its low "
                     "side to a face along {}: its particles end {:.2g} m off that face; make the "
                     "length a multiple of the spacing",
                     b.name, s.spacing, worst.length, "xyz"[worst.axis], worst.off * s.spacing),
         b.place});
  }
}

/// Density at the foot of a column over that at its top, minus 1, where liquid counts as too soft. A choice:
/// ten times what the default stiffness gives.
constexpr double too_soft = 0.05;

void soft_liquids(const Scene& s, std::vector<Finding>& found) {
  const double g = norm(s.gravity);
  for (const Body& b : s.bodies) {
    const Material& m = s.material(b.material);
    if (b.phase != Phase::liquid || !m.stiffness || !(g > 0.0)) continue;
    const Vec3 extent = bounds(b.shape).extent();
    double depth = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
      if (!s.periodic[a]) depth += std::abs(s.gravity[a]) / g * extent[a];
    const double rise = g * depth / *m.stiffness;
    if (!(rise > too_soft) || !std::isfinite(rise)) continue;
    found.push_back(
        {false,
         fmt::format("liquid \"{}\": its own weight presses it together by {:.0f} % at a sound speed of "
                     "{:.3g} m/s: give "
                     "sound_speed = {:.2g} m/s or more, ten times sqrt(2 g depth), or leave it out",
                     b.name, 100.0 * rise, std::sqrt(*m.stiffness), 10.0 * std::sqrt(2.0 * g * depth)),
         b.place});
  }
}

/// A fixed body that is turned about a level axis, so that its faces slope.
bool slopes(const Scene& s, const Body& b) {
  if (!is_wall(b) || !is_turned(b.shape)) return false;
  const Vec3 up = -1.0 / norm(s.gravity) * s.gravity;
  double steepest = 0.0;  // an axis of the body that stands upright has faces that lie level
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    steepest = std::max(steepest, std::abs(dot(rotate(b.shape.rotation, axis), up)));
  return steepest < 1.0 - 1e-6;
}

void slippery(const Scene& s, std::vector<Finding>& found) {
  if (!(norm(s.gravity) > 0.0) || !s.contact) return;
  const auto ramp = std::ranges::find_if(s.bodies, [&](const Body& b) { return slopes(s, b); });
  if (ramp == s.bodies.end()) return;
  const auto slider = std::ranges::find_if(s.bodies, [&](const Body& b) {
    return b.phase != Phase::liquid && b.motion == Motion::free &&
           !contact_law_of(s, b.material, ramp->material);
  });
  if (slider == s.bodies.end()) return;
  found.push_back(
      {false,
       fmt::format("body \"{}\" slopes, and no [[contact]] gives its material and that of \"{}\" a "
                   "friction: it slides as on ice",
                   ramp->name, slider->name),
       ramp->place});
}

/// How far heat spreads in a run [m]: sqrt(4 D t).
double reach_of_heat(const Scene& s, const Material& m) {
  const double capacity = std::min(heat_capacity_of(m, Phase::rigid), heat_capacity_of(m, Phase::liquid)),
               conductivity = std::max(conductivity_of(m, Phase::rigid), conductivity_of(m, Phase::liquid));
  return std::sqrt(4.0 * conductivity / (m.density * capacity) * s.end_time);
}

/// How deep a front gets in a run at most [m]: sqrt(2 k dT t/(rho L)), by heat that comes straight through
/// what has melted.
double reach_of_melting(const Scene& s, const Material& m, const TemperatureRange& range) {
  const double over = std::max(range.greatest - *m.t_melt, m.t_solid.value_or(*m.t_melt) - range.least);
  const double conductivity = std::max(conductivity_of(m, Phase::rigid), conductivity_of(m, Phase::liquid));
  return std::sqrt(2.0 * conductivity * over * s.end_time / (m.density * *m.latent_heat));
}

/// Matter that conducts less is meant to insulate [W/m/K]: a choice, a ten-thousandth of what air conducts.
constexpr double insulates = 2e-6;

void slow_heat(const Scene& s, std::vector<Finding>& found) {
  if (!calls_for(s, "heat") || equal_temperature(s)) return;
  const TemperatureRange range = temperatures_of(s);
  for (const Body& b : s.bodies) {
    const Material& m = s.material(b.material);
    if (!has_heat(b, m) || b.temperature_held) continue;
    const double reach = reach_of_heat(s, m);
    if (conductivity_of(m, Phase::rigid) <= insulates && conductivity_of(m, Phase::liquid) <= insulates)
      continue;
    if (reach < s.spacing) {
      found.push_back({false,
                       fmt::format("heat spreads {:.2g} m in body \"{}\" until end_time = {} s, less than a "
                                   "spacing: run longer, or "
                                   "give conductivity and temperatures that matter",
                                   reach, b.name, s.end_time),
                       b.place});
      continue;
    }
    if (!m.t_melt || !(m.latent_heat.value_or(0.0) > 0.0) || !calls_for(s, "phase") ||
        !std::isfinite(range.greatest))
      continue;
    const double depth = reach_of_melting(s, m, range);
    if (depth < s.spacing)
      found.push_back(
          {false,
           fmt::format(
               "melting or freezing gets {:.2g} m deep in body \"{}\" until end_time = {} s, less than a "
               "spacing: run longer, or refine scene.spacing",
               depth, b.name, s.end_time),
           b.place});
  }
}

/// Measured of liquids, elastic bodies and heat: 0.3 to 1.4 [s].
constexpr double cpu_of_a_particle_step = 0.6e-6;

/// Greatest step that the matter of a body allows, frozen too [s]: shares of the bounds of model 8.10 as runs
/// have shown them.
double step_of(const Scene& s, const Body& b, double liquid_sound) {
  const Material& m = s.material(b.material);
  double dt = std::numeric_limits<double>::infinity();
  if (b.phase == Phase::liquid && liquid_sound > 0.0) dt = std::min(dt, 1.0 * s.spacing / liquid_sound);
  const bool freezes_elastic =
      calls_for(s, "phase") && calls_for(s, "elastic") && m.t_melt && m.solid == SolidKind::elastic;
  if ((b.phase == Phase::elastic || freezes_elastic) && m.young_modulus && m.poisson_ratio) {
    const double nu = *m.poisson_ratio,
                 modulus = *m.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    dt = std::min(dt, 0.5 * s.spacing / std::sqrt(modulus / m.density));
  }
  if (has_heat(b, m) && !b.temperature_held && calls_for(s, "heat") && !equal_temperature(s)) {
    const double reach = reach_of_heat(s, m);  // sqrt(4 D end_time)
    dt = std::min(dt, 0.075 * std::pow(2.6 * s.spacing, 2) * 4.0 * s.end_time / (reach * reach));
  }
  return dt;
}

}  // namespace

std::optional<double> cpu_seconds(const Scene& s, const InitialState& state) {
  const auto by_default = default_stiffness(s);
  double dt = s.time_step.value_or(std::numeric_limits<double>::infinity()), moving = 0.0;
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    const Material& m = s.material(b.material);
    const double k = m.stiffness.value_or(by_default ? by_default->value : 0.0);
    if (!s.time_step) dt = std::min(dt, step_of(s, b, std::sqrt(k)));
    if (b.motion != Motion::fixed || has_heat(b, m))
      moving += static_cast<double>(std::ranges::count(state.source, static_cast<int>(n)));
  }
  if (!std::isfinite(dt)) return {};
  return cpu_of_a_particle_step * moving * s.end_time / dt;
}

std::vector<Finding> weak_containers(const Scene& s, const InitialState& state) {
  std::vector<Finding> found;
  if (!s.has_liquid()) return found;
  thin_walls(s, state, found);
  faces_off_rows(s, found);
  soft_liquids(s, found);
  return found;
}

std::vector<Finding> foreseen(const Scene& s) {
  std::vector<Finding> found;
  slippery(s, found);
  slow_heat(s, found);
  return found;
}

}  // namespace tripoint
