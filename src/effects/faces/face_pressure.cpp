// SPDX-License-Identifier: BSD-3-Clause
#include "effects/faces/face_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"
#include "scene/effect_rule.hpp"
#include "solids/bond_loads.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::faces {
FacePressure::FacePressure(const Scene& scene) : share_(acting_number(scene, "face_pressure")) {}

void FacePressure::find(const State& state) {
  if (!pairs_.renew(state.neighbours->rebuilds())) return;
  const Particles& p = state.particles;
  const auto rank = p[field::shape_rank];
  const solid::ElasticParticles moves_by_itself(state);
  elastic_.assign(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) elastic_[i] = rank[i] == 3 && moves_by_itself(i);
  find_bonded(state, find_pressed(state));
}

/// The pairs across a face. @return of each row, whether it has one
std::vector<char> FacePressure::find_pressed(const State& state) {
  const Particles& p = state.particles;
  const auto group = p[field::group];
  std::vector<char> pressed(p.size(), 0);
  const auto each_pair = [&](std::size_t i, auto give) {
    for (const Entry e : state.neighbours->of(i)) {
      const auto j = static_cast<std::uint32_t>(e.row());
      if ((elastic_[i] || elastic_[j]) && !e.own() && tripoint::acts(group[i], group[j]))
        give(liquid::ListedPair{j, e.image()});
    }
  };
  for (std::size_t i = 0; i < p.awake(); ++i)
    if (elastic_[i])
      each_pair(i, [&](const liquid::ListedPair& pair) { pressed[i] = pressed[pair.row] = 1; });
  for (std::uint32_t i = 0; i < p.awake(); ++i) {
    if (!pressed[i]) continue;
    each_pair(i, [&](const liquid::ListedPair& pair) { pairs_.add(pair); });
    pairs_.end_row(i);
  }
  return pressed;
}

/// Rows whose bonds a load passes on.
void FacePressure::find_bonded(const State& state, const std::vector<char>& pressed) {
  const Particles& p = state.particles;
  const auto id = p[field::id];
  bonded_.clear();
  // Only the owning process knows all loads on a copy, so a copy counts as loaded.
  const auto is_loaded = [&](std::size_t row) { return elastic_[row] && (pressed[row] || !state.owns(row)); };
  for (std::uint32_t i = 0; i < p.awake(); ++i) {
    const auto list = state.bonds.of(static_cast<std::size_t>(id[i]));
    if (is_loaded(i) || std::ranges::any_of(list, [&](const Bond& b) { return is_loaded(p.row(b.other)); }))
      bonded_.push_back(i);
  }
}

/// F of the elastic particles that are pressed, by (14), and D.
void FacePressure::deform(State& state) {
  const Particles& p = state.particles;
  const auto x = positions(p);
  const auto id = p[field::id];
  const auto volume = p[field::solid_volume];
  const auto shape = solid::shape_inverses(p);
  inverse_.resize(p.size());
  measure_.assign(p.size(), {});
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    if (!elastic_[i] || !state.owns(i)) return;
    Matrix3 sum;
    for (const Bond& b : state.bonds.of(static_cast<std::size_t>(id[i]))) {
      const std::size_t j = p.row(b.other);
      const Vec3 u = solid::nearest_image(state.box, x.at(j) - x.at(i)) + b.x;
      sum = sum + outer(u, volume[j] * b.gradient);
    }
    inverse_[i] = inverse(solid::deformation_gradient(sum, shape.at(i)));
    measure_[static_cast<std::size_t>(id[i])] =
        (0.5 * share_) * symmetric_part(transposed(inverse_[i]) * inverse_[i] - identity3);
  });
  state.hand_to_ghosts(measure_);
}

void FacePressure::add_densities(State& state, const PairKernels& kernels) {
  find(state);
  deform(state);
  const Particles& p = state.particles;
  const auto x = positions(p);
  const auto id = p[field::id];
  const auto delta = state.particles[field::number_density];
  const double support2 = state.support() * state.support();
  near_.resize(pairs_.pairs());
  acting_.resize(pairs_.rows());
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    Near* const first = near_.data() + pairs_.first(n);
    Near* last = first;
    for (const liquid::ListedPair& pair : pairs_.of(n)) {
      const std::uint32_t j = pair.row;
      const Vec3 d = liquid::way_to(*state.neighbours, x, i, pair);
      const double here2 = dot(d, d);
      const double at_face2 =
          dot(d, seen_at_face(static_cast<std::size_t>(id[i]), static_cast<std::size_t>(id[j]), d));
      if (!(std::min(here2, at_face2) < support2)) continue;
      const double here = std::sqrt(here2);
      const double at_face = std::sqrt(at_face2);
      delta[i] += kernels.wendland.value(at_face) - kernels.wendland.value(here);
      *last++ = {j, d, kernels.wendland.derivative_over_r(at_face), kernels.wendland.derivative_over_r(here)};
    }
    acting_[n] = static_cast<std::size_t>(last - first);
  });
}

/// With y = F^-1 d: dU/dF = -s/2 F^-T sum_j (share_i + share_j) W'(r*)/r* y y^T.
void FacePressure::add_forces(State& state, const Rows& rows) {
  Particles& p = state.particles;
  const auto share = std::as_const(p)[field::pressure_share];
  const auto id = p[field::id];
  const auto F = triple(p, field::force);
  const auto shape = solid::shape_inverses(std::as_const(p));
  load_.assign(p.size(), {});
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    const auto own = static_cast<std::size_t>(id[i]);
    Vec3 f;
    Symmetric pressed;  // sum_j (share_i + share_j) W'(r*)/r* d d^T
    for (const Near& pair : std::span(near_).subspan(pairs_.first(n), acting_[n])) {
      const double pressure = share[i] + share[pair.row];
      const Vec3 at_face = seen_at_face(own, static_cast<std::size_t>(id[pair.row]), pair.d);
      f += pressure * (pair.at_face * at_face - pair.here * pair.d);
      if (elastic_[i]) pressed = pressed + (pressure * pair.at_face) * square(pair.d);
    }
    if (rows.has(i)) F.set(i, F.at(i) + f);
    if (elastic_[i] && state.owns(i))
      load_[own] = (-0.5 * share_) *
                   (transposed(inverse_[i]) * (inverse_[i] * full(pressed) * transposed(inverse_[i]))) *
                   shape.at(i);
  });
  state.hand_to_ghosts(load_);
  solid::add_bond_loads(state, rows, bonded_, load_);
}

}  // namespace tripoint::faces
