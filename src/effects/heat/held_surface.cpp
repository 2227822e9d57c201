// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/held_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "effects/heat/fields.hpp"
#include "effects/heat/heat_terms.hpp"
#include "effects/heat/surface_faces.hpp"
#include "sampling/shape_distance.hpp"
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
    place = put_back(scene_, place);
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
  Vec3 exit;      ///< where the way leaves the body [m]
};

/// Steps of the lattice that the support reaches [spacings]. That of a body that was laid turned is turned.
std::vector<Vec3> steps_within(double support_ratio, Dimensions d, const Quaternion& turn) {
  const int most = static_cast<int>(support_ratio), deep = d == Dimensions::three ? most : 0;
  std::vector<Vec3> steps;
  for (int x = -most; x <= most; ++x)
    for (int y = -deep; y <= deep; ++y)
      for (int z = -most; z <= most; ++z) {
        const Vec3 step{double(x), double(y), double(z)};
        if (const double r = norm(step); r > 0.0 && r < support_ratio) steps.push_back(rotate(turn, step));
      }
  return steps;
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
    const double way = way_within(inside, at, away);
    found.push_back({away, std::max(way, least_way), at + way * away});
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

/// How deep a particle lies below the plane through the exit of its way [m].
double depth_below(const PlaceFunction& distance, const Beyond& b, double spacing) {
  return std::max(dot(normal_at(distance, b.exit, spacing), b.within * b.away), least_way * spacing);
}

/// The same function of places beyond periodic sides too.
template <class Function>
Function across_sides(const Scene& scene, Function function) {
  return [&scene, function = std::move(function)](const Vec3& r) { return function(put_back(scene, r)); };
}

bool has_sources(const Scene& scene, const Body& b) {
  return std::ranges::any_of(scene.sources, [&](const HeatSource& s) { return acts_on(s, b); });
}

/// w of a place at distance r, in the sums of model 8.6 [m]
double weight(const State& state, double r) {
  const double K = -2.0 * WendlandC2(state.support(), state.scene.space()).derivative_over_r(r);
  return 0.5 * state.scene.cell() * K;
}

constexpr std::array<const Field<double>*, 6> inverse = columns_of(field::moment_inverse);
constexpr std::array<const Field<double>*, 18> sums = HeatMoment::adds::list;

}  // namespace

std::optional<double> surface_temperature(const Scene& scene, const Body& b) {
  const double held = value_of(scene.material(b.material).values, "surface_temperature");
  return held > 0.0 && b.motion == Motion::fixed && b.phase != Phase::liquid ? std::optional(held)
                                                                             : std::nullopt;
}

bool has_held_surfaces(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [&](const Body& b) {
    return surface_temperature(scene, b).has_value() || has_sources(scene, b);
  });
}

namespace {

/// Why heat cannot pass the surface of a body, and what to write instead; empty = it can.
std::string surface_refusal(const Scene& scene, const Body& b) {
  if (scene.mode_of(term::heat) == Mode::paper)
    return "and heat as printed knows no surfaces: let heat be corrected (model.heat, case.modes), or hold a "
           "body beside it";
  if (b.motion != Motion::fixed || b.phase == Phase::liquid)
    return "and such a surface stays where it was laid: write motion = \"fixed\" for a solid body";
  if (scene.material(b.material).t_melt && calls_for(scene, "phase"))
    return "and its surface would melt away: leave t_melt out of the material, or hold a body beside it";
  for (const Event& e : scene.events)
    if (e.kind == Event::Kind::release && std::ranges::find(e.bodies, b.name) != e.bodies.end())
      return "and it is released: such a surface stays where it was laid";
  return {};
}

void refuse_surface_sources(const Scene& scene) {
  for (const HeatSource& s : scene.sources) {
    if (!s.is_of_surfaces()) continue;
    if (std::ranges::none_of(scene.bodies, [&](const Body& b) { return acts_on(s, b); }) && s.bodies.empty())
      throw InputError(s.place, "heat passes surfaces of fixed solid bodies alone, and the scene has none");
    for (const Body& b : scene.bodies) {
      if (!acts_on(s, b) && std::ranges::find(s.bodies, b.name) == s.bodies.end()) continue;
      if (const auto why = surface_refusal(scene, b); !why.empty())
        throw InputError(s.place,
                         fmt::format("a source acts through the surface of body \"{}\", {}", b.name, why));
    }
  }
}

}  // namespace

void refuse_held_surfaces(const Scene& scene) {
  refuse_surface_sources(scene);
  for (const Body& b : scene.bodies) {
    const Material& m = scene.material(b.material);
    if (!(value_of(m.values, "surface_temperature") > 0.0)) continue;
    if (const auto why = surface_refusal(scene, b); !why.empty())
      throw InputError(
          fmt::format("body \"{}\" is of {}, which has a surface_temperature, {}", b.name, m.name, why));
  }
}

namespace {

void hold_at_a_face(Particles& p, std::size_t row, const std::vector<Beyond>& beyond, double dx,
                    double temperature) {
  if (!leaves_by_a_face(beyond, dx)) return;
  p[field::held][row] = 1;
  p[field::temperature][row] = temperature;
}

/// What a body's surface is made of; empty where nothing passes it.
struct Surface {
  std::optional<double> held_at;  ///< [K]
  bool heated = false;
  Inside inside;
  PlaceFunction distance;
  std::vector<Vec3> steps;  ///< of the lattice [spacings]
  [[nodiscard]] bool passes() const { return held_at || heated; }
};

std::vector<Surface> surfaces_of(const Scene& scene) {
  std::vector<Surface> all;
  for (const Body& b : scene.bodies) {
    Surface& s = all.emplace_back(Surface{surface_temperature(scene, b), has_sources(scene, b), {}, {}, {}});
    if (!s.passes()) continue;
    s.inside = across_sides(scene, inside_of(b.shape, scene.spacing));
    if (s.heated) s.distance = across_sides(scene, distance_of(b.shape, scene.spacing));
    s.steps = steps_within(scene.support_ratio, scene.space(), b.shape.rotation);
  }
  return all;
}

/// Flow through one face on the way to a place beyond.
struct Through {
  std::uint32_t sources;  ///< that act there; 0: it is held
  double depth, within;   ///< as of Near [m], and the share of the way in the body [1]
};

/// @param acting sources that act at a place of the surface @return none where one of the faces passes no
/// heat
template <class Acting>
std::vector<Through> flows_to(const Surface& s, const Beyond& b, const Vec3& at, double dx, Acting acting) {
  const auto faces = s.held_at ? std::vector<Face>{} : faces_between(s.inside, s.distance, at, b.away, dx);
  if (faces.size() < 2) {
    const std::uint32_t sources = s.heated ? acting(b.exit) : 0;
    if (sources == 0 && !s.held_at) return {};
    return {{sources, sources != 0 ? depth_below(s.distance, b, dx) : 0.0, b.within}};
  }
  const double nearer = b.within * norm(b.away) / norm(b.exit - at);
  const auto ways = ways_across(faces, b.away);
  std::vector<Through> all;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double depth = nearer * faces[f].depth;
    // Below the particle, as a way may leave by the very edge
    all.push_back({acting(at + faces[f].depth * faces[f].normal), depth, depth / ways[f]});
    if (all.back().sources == 0) return {};
  }
  return all;
}

}  // namespace

void HeldSurfaces::load(State& state, const InitialState& initial) {
  all_.clear();
  near_.clear();
  const Scene& scene = state.scene;
  if (!has_held_surfaces(scene)) return;
  sources_.emplace(scene);
  const Laid laid(initial, scene);
  Particles& p = state.particles;
  const std::vector<Surface> surfaces = surfaces_of(scene);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto source = static_cast<std::size_t>(p[field::source][i]);
    if (source >= surfaces.size() || !surfaces[source].passes()) continue;
    const Surface& surface = surfaces[source];
    const auto id = static_cast<std::uint32_t>(p[field::id][i]);
    const Vec3& at = initial.position[id];
    const auto beyond = places_beyond(scene, surface.inside, at, surface.steps, laid);
    if (!acts(scene) && surface.held_at) {
      hold_at_a_face(p, i, beyond, scene.spacing, *surface.held_at);
      continue;
    }
    const auto acting = [&](const Vec3& exit) { return sources_->acting(scene, scene.bodies[source], exit); };
    const std::size_t first = all_.size();
    for (const Beyond& b : beyond) {
      bool counted = false;  // a place counts once in the moments, through however many faces heat comes
      for (const Through& t : flows_to(surface, b, at, scene.spacing, acting)) {
        Near& near = alike({id, surface.held_at.value_or(0.0), t.sources, t.depth}, first);
        if (!std::exchange(counted, true)) add_moment(state, b.away, near);
        add_exchange(state, i, b.away, t.within, near);
      }
    }
  }
  std::ranges::stable_sort(all_, {}, &Near::id);
  near_ = all_;
}

/// That of a particle's entries, from `first` on, which has the same surface; a new one where none has.
HeldSurfaces::Near& HeldSurfaces::alike(const Near& near, std::size_t first) {
  constexpr double same = 1e-6;  // of the depth: ways through one plane face have the same but for round-off
  for (std::size_t n = first; n < all_.size(); ++n)
    if (all_[n].sources == near.sources && std::abs(all_[n].depth - near.depth) <= same * near.depth)
      return all_[n];
  return all_.emplace_back(near);
}

void HeldSurfaces::add_moment(const State& state, const Vec3& away, Near& near) {
  const double r = norm(away), w = weight(state, r);
  const auto rr = outer(away);
  for (std::size_t c = 0; c < 6; ++c) near.moment[c] += w * rr[0] * rr[c] / (r * r);
  for (std::size_t c = 1; c < 6; ++c) near.moment[5 + c] += w * rr[1] * rr[c] / (r * r);
  for (std::size_t c = 2; c < 6; ++c) near.moment[9 + c] += w * rr[2] * rr[c] / (r * r);
  for (std::size_t c = 0; c < 3; ++c) near.moment[15 + c] += 2.0 * w * away[c];
}

void HeldSurfaces::add_exchange(const State& state, std::size_t row, const Vec3& away, double within,
                                Near& near) {
  const double own = state.particles[field::mass][row] / state.material_of(row).density;
  const double r = norm(away), w = weight(state, r);
  const auto rr = outer(away);
  for (std::size_t c = 0; c < 6; ++c) near.exchange[c] += 2.0 * own * w * rr[c] / (r * r * within);
}

void HeldSurfaces::renumber(const State& state) {
  if (all_.empty()) return;
  near_.clear();
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const std::uint32_t number = state.halo ? static_cast<std::uint32_t>(state.halo->numbers()[id]) : id;
    for (auto one = std::ranges::lower_bound(all_, number, {}, &Near::id);
         one != all_.end() && one->id == number; ++one) {
      near_.push_back(*one);
      near_.back().id = id;
    }
  }
}

HeldSurfaces::Flow HeldSurfaces::flow(const State& state, std::size_t row, const Near& near) const {
  const Particles& p = state.particles;
  double sum = 0.0;
  for (std::size_t c = 0; c < 6; ++c) sum += (c < 3 ? 1.0 : 2.0) * p[*inverse[c]][row] * near.exchange[c];
  const double k = p[field::conductivity][row], T = p[field::temperature][row],
               conductance = k * std::max(sum, 0.0);
  if (near.sources == 0) return {conductance * (near.temperature - T), conductance};
  const auto surface = sources_->balance(near.sources, state.time, k / near.depth, T);
  return {conductance * (surface.temperature - T),
          conductance * surface.slope / (k / near.depth + surface.slope)};
}

void HeldSurfaces::start_sums(State& state, PassName pass) const {
  Particles& p = state.particles;
  for (const Near& near : near_) {
    const std::size_t i = p.row(near.id);
    if (pass == PassName::density) {
      for (std::size_t c = 0; c < sums.size(); ++c) p[*sums[c]][i] += near.moment[c];
      continue;
    }
    const Flow now = flow(state, i, near);
    p[field::conductance][i] += now.conductance;
    p[field::heat_rate][i] += now.heat;
  }
}

template <class Visit>
void HeldSurfaces::each_particle(const State& state, Visit visit) const {
  for (std::size_t n = 0; n < near_.size();) {
    const std::uint32_t id = near_[n].id;
    const std::size_t row = state.particles.row(id);
    double heat = 0.0;
    for (; n < near_.size() && near_[n].id == id; ++n) heat += flow(state, row, near_[n]).heat;
    visit(row, heat);
  }
}

void HeldSurfaces::accumulate(State& state, Stage stage, double dt) const {
  if (near_.empty()) return;
  Particles& p = state.particles;
  const auto before = p[field::surface_flow_before];
  const bool by_body = state.bodies.has(field::body_heat.name);
  double sum = 0.0;
  each_particle(state, [&](std::size_t i, double now) {
    if (!state.owns(i) || p[field::held][i]) return;
    const double given = stage == Stage::first ? dt * now : 0.5 * dt * (now - before[i]);
    if (stage == Stage::first) before[i] = now;
    sum += given;
    if (const int b = p[field::body][i]; by_body && b >= 0)
      state.bodies[field::body_heat][static_cast<std::size_t>(b)] += given;
  });
  state.accumulated[account::walls] -= sum;
}

}  // namespace tripoint::heat
