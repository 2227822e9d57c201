// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/held_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <unordered_map>
#include <utility>

#include "effects/heat/fields.hpp"
#include "effects/heat/heat_terms.hpp"
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

/// Least share, within the body, of the way to a place beyond the surface [1]. Jitter may have put the
/// particle outside the shape, where the share would be 0. A choice, small beside least_distance.
constexpr double least_way = 1e-3;

/// Faces that meet at less than 45 degrees count as one that is curved [1]. A choice.
constexpr double one_face = 0.707;
/// Slope of the distance on a plane face is 1, and at an edge less [1]. A choice.
constexpr double clean_slope = 0.9;

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

/// Gradient of the distance from a surface, by differences [1].
Vec3 gradient_at(const PlaceFunction& distance, const Vec3& r, double spacing) {
  const double step =
      0.05 * spacing;  // a choice: fields of meshes are linear between points half a spacing apart
  Vec3 n;
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 e;
    e[a] = step;
    n[a] = (distance(r + e) - distance(r - e)) / (2.0 * step);
  }
  return n;
}

/// Normal of the surface of a shape [1].
Vec3 normal_at(const PlaceFunction& distance, const Vec3& r, double spacing) {
  const Vec3 n = gradient_at(distance, r, spacing);
  return norm(n) > 0.0 ? n / norm(n) : n;
}

/// How deep a particle lies below the plane through the exit of its way [m].
double depth_below(const PlaceFunction& distance, const Beyond& b, double spacing) {
  return std::max(dot(normal_at(distance, b.exit, spacing), b.within * b.away), least_way * spacing);
}

/// A face of the surface between a particle and a place beyond.
struct Face {
  Vec3 exit;     ///< where a way passes it [m]
  Vec3 normal;   ///< outwards [1]
  double depth;  ///< of the particle below it [m]
};

bool is_another(const Vec3& n, const std::vector<Face>& known) {
  return std::ranges::none_of(known, [&](const Face& f) { return dot(n, f.normal) > one_face; });
}

/// Normal of the face that a way passes: at an edge that of one of its faces, which is none of `known`.
Vec3 normal_of_face(const PlaceFunction& distance, const Vec3& exit, double spacing,
                    const std::vector<Face>& known) {
  const auto slope = [&](const Vec3& r) { return gradient_at(distance, r, spacing); };
  const Vec3 raw = slope(exit);
  if (norm(raw) > clean_slope) return raw / norm(raw);
  for (std::size_t a = 0; a < 3; ++a)
    for (const double aside : {0.2 * spacing, -0.2 * spacing}) {
      Vec3 r = exit;
      r[a] += aside;
      const Vec3 n = slope(r);
      if (norm(n) > clean_slope && is_another(n / norm(n), known)) return n / norm(n);
    }
  return norm(raw) > 0.0 ? raw / norm(raw) : raw;
}

/// Faces between a particle and a place beyond: one, and at an edge or a corner two or three. The second is
/// that through which the way leaves that goes along the first.
std::vector<Face> faces_between(const Inside& inside, const PlaceFunction& distance, const Vec3& at,
                                const Vec3& away, double spacing) {
  std::vector<Face> faces;
  std::vector<Vec3> across;  // an orthogonal frame of the normals
  Vec3 way = away;
  while (faces.size() < 3 && !inside(at + way)) {
    const Vec3 to = way_within(inside, at, way) * way;
    const Vec3 n = normal_of_face(distance, at + to, spacing, faces);
    if (!is_another(n, faces)) break;
    faces.push_back({at + to, n, std::max(dot(n, to), least_way * spacing)});
    Vec3 own = n;
    for (const Vec3& e : across) own = own - dot(own, e) * e;
    across.push_back(own / norm(own));
    way = way - dot(way, across.back()) * across.back();
  }
  return faces;
}

/// Shares s of the faces: where q_f flows in through face f, the temperature of the place is that of the
/// particle + sum s_f q_f/k, in the linear field that has k n_f . grad T = q_f at each. [m]
std::vector<double> ways_across(const std::vector<Face>& faces, const Vec3& away) {
  const auto count = static_cast<Eigen::Index>(faces.size());
  Eigen::MatrixXd normals(count, 3);
  for (Eigen::Index f = 0; f < count; ++f)
    for (Eigen::Index a = 0; a < 3; ++a)
      normals(f, a) = faces[static_cast<std::size_t>(f)].normal[static_cast<std::size_t>(a)];
  const Eigen::VectorXd s =
      (normals * normals.transpose()).ldlt().solve(normals * Eigen::Vector3d(away.x, away.y, away.z));
  return {s.begin(), s.end()};
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

}  // namespace

void HeldSurfaces::load(State& state, const InitialState& initial) {
  all_.clear();
  near_.clear();
  const Scene& scene = state.scene;
  if (!has_held_surfaces(scene)) return;
  sources_.emplace(scene);
  const Laid laid(initial, scene);
  const double dx = scene.spacing;
  Particles& p = state.particles;
  std::vector<Inside> insides(scene.bodies.size());
  std::vector<PlaceFunction> distances(scene.bodies.size());
  std::vector<std::vector<Vec3>> steps(scene.bodies.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto source = static_cast<std::size_t>(p[field::source][i]);
    if (source >= scene.bodies.size()) continue;
    const Body& body = scene.bodies[source];
    const auto held_at = surface_temperature(scene, body);
    const bool heated = has_sources(scene, body);
    if (!held_at && !heated) continue;
    if (!insides[source]) {
      insides[source] = across_sides(scene, inside_of(body.shape, dx));
      steps[source] = steps_within(scene.support_ratio, scene.space(), body.shape.rotation);
    }
    if (heated && !distances[source]) distances[source] = across_sides(scene, distance_of(body.shape, dx));
    const auto id = static_cast<std::uint32_t>(p[field::id][i]);
    const auto beyond = places_beyond(scene, insides[source], initial.position[id], steps[source], laid);
    if (!acts(scene) && held_at) {
      hold_at_a_face(p, i, beyond, dx, *held_at);
      continue;
    }
    const std::size_t first = all_.size();
    const Vec3& at = initial.position[id];
    for (const Beyond& b : beyond) {
      const auto faces =
          heated ? faces_between(insides[source], distances[source], at, b.away, dx) : std::vector<Face>{};
      const auto acting = [&](const Vec3& exit) {
        return heated ? sources_->acting(scene, body, exit) : std::uint32_t{0};
      };
      if (faces.size() > 1 && !held_at) {
        if (std::ranges::any_of(faces, [&](const Face& f) { return acting(f.exit) == 0; })) continue;
        const double nearer = b.within * norm(b.away) / norm(b.exit - at);
        const auto ways = ways_across(faces, b.away);
        for (std::size_t f = 0; f < faces.size(); ++f) {
          const double depth = nearer * faces[f].depth;
          Near& near = alike({id, 0.0, acting(faces[f].exit), depth}, first);
          if (f == 0) add_moment(state, b.away, near);
          add_exchange(state, i, b.away, depth / ways[f], near);
        }
        continue;
      }
      const std::uint32_t sources = acting(b.exit);
      if (sources == 0 && !held_at) continue;
      const double depth = sources != 0 ? depth_below(distances[source], b, dx) : 0.0;
      Near& near = alike({id, held_at.value_or(0.0), sources, depth}, first);
      add_moment(state, b.away, near);
      add_exchange(state, i, b.away, b.within, near);
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
