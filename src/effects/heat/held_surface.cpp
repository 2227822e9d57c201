// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/held_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "effects/heat/fields.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shared_terms.hpp"
#include "sph/kernels.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::heat {
namespace {

/// A particle nearer to the surface than this is taken to be this far [spacings]. Its conductance to the
/// surface goes with one over the distance, and the step with one over the conductance. Boxes that the
/// lattice fits have half a spacing everywhere.
constexpr double least_distance = 0.25;
/// Another particle this near to a place of the lattice stands there [spacings]: jitter moves it by less, and
/// two places are 1 apart.
constexpr double same_place = 0.75;

/// Least share, within the body, of the way to a place beyond the surface [1]. Jitter may have put the
/// particle outside the shape, where the share would be 0. A choice, small beside least_distance.
constexpr double least_way = 1e-3;

bool acts(const Scene& scene) {
  return kept_number(scene.values, key_row("scene", "surface_exchange")) != 0.0;
}

/// Particles as they were laid, by cells of one spacing.
class Laid {
 public:
  Laid(const InitialState& initial, const Scene& scene) : places_(initial.position), scene_(scene) {
    for (std::size_t i = 0; i < places_.size(); ++i) cells_[key(cell_of(places_[i]))].push_back(i);
  }
  /// Whether a particle stands at the place, or at one of its periodic images.
  [[nodiscard]] bool taken(Vec3 place) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (!scene_.periodic[a]) continue;
      const double width = (*scene_.max)[a] - (*scene_.min)[a];
      place[a] -= width * std::floor((place[a] - (*scene_.min)[a]) / width);
    }
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (stands_in(cell_of(place + scene_.spacing * Vec3{double(x), double(y), double(z)}), place))
            return true;
    return false;
  }

 private:
  using Cell = std::array<long, 3>;
  [[nodiscard]] Cell cell_of(const Vec3& r) const {
    Cell cell{};
    for (std::size_t a = 0; a < 3; ++a) cell[a] = std::lround(std::floor(r[a] / scene_.spacing));
    return cell;
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t k = 0;
    for (const long n : c) k = (k << 21) ^ (static_cast<std::uint64_t>(n) & 0x1fffffU);
    return k;
  }
  [[nodiscard]] bool stands_in(const Cell& cell, const Vec3& place) const {
    const auto found = cells_.find(key(cell));
    if (found == cells_.end()) return false;
    return std::ranges::any_of(found->second, [&](std::size_t i) { return near(places_[i], place); });
  }
  /// Across periodic sides too.
  [[nodiscard]] bool near(const Vec3& a, const Vec3& b) const {
    Vec3 d = a - b;
    for (std::size_t k = 0; k < 3; ++k)
      if (scene_.periodic[k]) d[k] = std::remainder(d[k], (*scene_.max)[k] - (*scene_.min)[k]);
    return norm(d) < same_place * scene_.spacing;
  }

  const std::vector<Vec3>& places_;
  const Scene& scene_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// A place of the lattice beyond the surface, and the share of the way there that lies within the body.
struct Beyond {
  Vec3 away;      ///< [m]
  double within;  ///< of 0..1
};

/// Steps of the lattice that the support reaches [spacings].
std::vector<Vec3> steps_within(double support_ratio) {
  const int most = static_cast<int>(support_ratio);
  std::vector<Vec3> steps;
  for (int x = -most; x <= most; ++x)
    for (int y = -most; y <= most; ++y)
      for (int z = -most; z <= most; ++z) {
        const Vec3 step{double(x), double(y), double(z)};
        if (const double r = norm(step); r > 0.0 && r < support_ratio) steps.push_back(step);
      }
  return steps;
}

using Inside = std::function<bool(const Vec3&)>;

/// Share of the way from a point in the shape to one outside at which it leaves the shape, by halving: to a
/// billionth.
double way_within(const Inside& inside, const Vec3& from, const Vec3& away) {
  double in = 0.0, out = 1.0;
  for (int n = 0; n < 30; ++n) {
    const double middle = 0.5 * (in + out);
    (inside(from + middle * away) ? in : out) = middle;
  }
  return 0.5 * (in + out);
}

/// There is nothing outside the domain. Where a side of the domain cuts a body, that side is a plane of
/// symmetry.
bool cut_off(const Scene& scene, const Vec3& place) {
  if (!(scene.min && scene.max)) return false;
  for (std::size_t a = 0; a < 3; ++a)
    if (!scene.periodic[a] && (place[a] < (*scene.min)[a] || place[a] > (*scene.max)[a])) return true;
  return false;
}

std::vector<Beyond> places_beyond(const Scene& scene, const Inside& inside, const Vec3& at,
                                  const std::vector<Vec3>& steps, const Laid& laid) {
  const double dx = scene.spacing;
  std::vector<Beyond> found;
  double nearest = least_distance * dx;
  for (const Vec3& step : steps) {
    const Vec3 away = dx * step, place = at + away;
    if (inside(place) || cut_off(scene, place) || laid.taken(place)) continue;
    found.push_back({away, std::max(way_within(inside, at, away), least_way)});
    nearest = std::min(nearest, found.back().within * norm(away));
  }
  for (Beyond& b : found) b.within *= least_distance * dx / nearest;
  return found;
}

std::array<double, 6> outer(const Vec3& r) {
  return {r.x * r.x, r.y * r.y, r.z * r.z, r.y * r.z, r.x * r.z, r.x * r.y};
}

bool leaves_by_a_face(const std::vector<Beyond>& beyond, double spacing) {
  return std::ranges::any_of(beyond, [&](const Beyond& b) { return norm(b.away) < 1.1 * spacing; });
}

constexpr std::array<const Field<double>*, 6> inverse = columns_of(field::moment_inverse);

}  // namespace

std::optional<double> surface_temperature(const Scene& scene, const Body& b) {
  const double held = value_of(scene.material(b.material).values, "surface_temperature");
  return held > 0.0 && b.motion == Motion::fixed && b.phase != Phase::liquid ? std::optional(held)
                                                                             : std::nullopt;
}

bool has_held_surfaces(const Scene& scene) {
  return std::ranges::any_of(scene.bodies,
                             [&](const Body& b) { return surface_temperature(scene, b).has_value(); });
}

void refuse_held_surfaces(const Scene& scene) {
  for (const Body& b : scene.bodies) {
    const Material& m = scene.material(b.material);
    if (!(value_of(m.values, "surface_temperature") > 0.0)) continue;
    const auto refuse = [&](const std::string& why) {
      throw InputError(
          fmt::format("body \"{}\" is of {}, which has a surface_temperature, {}", b.name, m.name, why));
    };
    if (scene.mode_of(term::heat) == Mode::paper)
      refuse(
          "and heat as printed knows no surfaces: write modes.heat = \"corrected\", or hold a body beside "
          "it");
    if (b.motion != Motion::fixed || b.phase == Phase::liquid)
      refuse(
          "and a held surface stays where it was laid: write motion = \"fixed\" for a solid body, or give it "
          "another material");
    if (m.t_melt && calls_for(scene, "phase"))
      refuse("and its surface would melt away: leave t_melt out of the material, or hold a body beside it");
    for (const Event& e : scene.events)
      if (e.kind == Event::Kind::release && std::ranges::find(e.bodies, b.name) != e.bodies.end())
        refuse("and it is released: a held surface stays where it was laid");
  }
}

void HeldSurfaces::load(State& state, const InitialState& initial) {
  all_.clear();
  near_.clear();
  const Scene& scene = state.scene;
  if (!has_held_surfaces(scene)) return;
  const Laid laid(initial, scene);
  const std::vector<Vec3> steps = steps_within(scene.support_ratio);
  const WendlandC2 kernel(state.support());
  const double dx = scene.spacing, volume = dx * dx * dx;
  Particles& p = state.particles;
  std::vector<Inside> insides(scene.bodies.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto source = static_cast<std::size_t>(p[field::source][i]);
    if (source >= scene.bodies.size()) continue;
    const auto held_at = surface_temperature(scene, scene.bodies[source]);
    if (!held_at) continue;
    if (!insides[source]) insides[source] = inside_of(scene.bodies[source].shape, dx);
    const auto id = static_cast<std::uint32_t>(p[field::id][i]);
    const auto beyond = places_beyond(scene, insides[source], initial.position[id], steps, laid);
    if (!acts(scene)) {
      if (leaves_by_a_face(beyond, dx)) {
        p[field::held][i] = 1;
        p[field::temperature][i] = *held_at;
      }
      continue;
    }
    if (beyond.empty()) continue;
    Near near{id, *held_at};
    const double own = p[field::mass][i] / state.material_of(i).density;
    for (const Beyond& b : beyond) {
      const double r = norm(b.away), K = -2.0 * kernel.derivative_over_r(r);
      const auto rr = outer(b.away);
      for (std::size_t c = 0; c < 6; ++c) {
        near.moment[c] += 0.5 * volume * K * rr[c];
        near.exchange[c] += own * volume * K * rr[c] / (r * r * b.within);
      }
    }
    all_.push_back(near);
  }
  std::ranges::sort(all_, {}, &Near::id);
  near_ = all_;
}

void HeldSurfaces::renumber(const State& state) {
  if (all_.empty()) return;
  near_.clear();
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const std::uint32_t number = state.halo ? static_cast<std::uint32_t>(state.halo->numbers()[id]) : id;
    const auto one = std::ranges::lower_bound(all_, number, {}, &Near::id);
    if (one == all_.end() || one->id != number) continue;
    near_.push_back(*one);
    near_.back().id = id;
  }
}

double HeldSurfaces::conductance(const Particles& p, std::size_t row, const Near& near) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 6; ++c) sum += (c < 3 ? 1.0 : 2.0) * p[*inverse[c]][row] * near.exchange[c];
  return p[field::conductivity][row] * sum;
}

double HeldSurfaces::flow(const Particles& p, std::size_t row, const Near& near) {
  return conductance(p, row, near) * (near.temperature - p[field::temperature][row]);
}

void HeldSurfaces::start_sums(State& state, PassName pass) const {
  Particles& p = state.particles;
  for (const Near& near : near_) {
    const std::size_t i = p.row(near.id);
    if (pass == PassName::density) {
      for (std::size_t c = 0; c < 6; ++c) p[*inverse[c]][i] = near.moment[c];
      continue;
    }
    p[field::conductance][i] = conductance(p, i, near);
    p[field::heat_rate][i] = flow(p, i, near);
  }
}

void HeldSurfaces::book(State& state, Stage stage, double dt) const {
  if (near_.empty()) return;
  Particles& p = state.particles;
  const auto before = p[field::surface_flow_before];
  const bool by_body = state.bodies.has(field::body_heat.name);
  double sum = 0.0;
  for (const Near& near : near_) {
    const std::size_t i = p.row(near.id);
    if (!state.owns(i) || p[field::held][i]) continue;
    const double now = flow(p, i, near);
    const double given = stage == Stage::first ? dt * now : 0.5 * dt * (now - before[i]);
    if (stage == Stage::first) before[i] = now;
    sum += given;
    if (const int b = p[field::body][i]; by_body && b >= 0)
      state.bodies[field::body_heat][static_cast<std::size_t>(b)] += given;
  }
  state.booked[account::walls] -= sum;
}

}  // namespace tripoint::heat
