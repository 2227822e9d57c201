// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/elastic_faces.hpp"

#include "effects/carried_liquid/fields.hpp"
#include "solids/bond_loads.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::carried_liquid {
namespace {

/// Of a particle, F - I amid the drift, and dF/dt.
struct Motion {
  Matrix3 F, rate;
};

/// Sums over the bonds of a row. @param back time since then [s]
Motion motion_of(const State& state, std::size_t i, double back) {
  const Particles& p = state.particles;
  const auto x = positions(p);
  const auto v = triple(p, field::predicted);
  const auto volume = p[field::solid_volume];
  Motion m;
  for (const Bond& b : state.bonds.of(static_cast<std::size_t>(p[field::id][i]))) {
    const std::size_t j = p.row(b.other);
    const Vec3 part = v.at(j) - v.at(i), gradient = volume[j] * b.gradient;
    m.F = m.F + outer(solid::nearest_image(state.box, x.at(j) - x.at(i)) + b.x - back * part, gradient);
    m.rate = m.rate + outer(part, gradient);
  }
  const Symmetric A = solid::shape_inverse_of(p, i);
  return {solid::deformation_gradient(m.F, A), m.rate * A};
}

/// Of each row, whether it is an elastic particle that liquid touches.
class Faces {
 public:
  explicit Faces(const State& state)
      : state_(state),
        rank_(state.particles[field::shape_rank]),
        touching_(state.particles[field::touching]),
        halfway_(state.particles[field::touching_halfway]),
        moves_by_itself_(state) {}
  [[nodiscard]] bool operator()(std::size_t i) const {
    return rank_[i] == 3 && (touching_[i] > 0.0 || halfway_[i] > 0.0) && i < state_.particles.awake() &&
           moves_by_itself_(i);
  }

 private:
  const State& state_;
  std::span<const int> rank_;
  std::span<const double> touching_, halfway_;
  solid::ElasticParticles moves_by_itself_;
};

}  // namespace

std::vector<double> ElasticFaces::where_they_meet(const State& state) {
  const Particles& p = state.particles;
  const auto z = p[field::impedance], solids = p[field::wall_share], liquids = p[field::touching];
  std::vector<double> meet(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) meet[i] = z[i] != 0.0 ? solids[i] : liquids[i];
  return meet;
}

void ElasticFaces::set_rates(State& state, double half_step) const {
  const auto rate = symmetric_columns(state.particles, field::face_rate);
  const Faces is_face(state);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    Symmetric e;
    if (is_face(i) && state.owns(i)) {
      const Motion m = motion_of(state, i, half_step);
      e = symmetric_part(m.rate * inverse(m.F));
    }
    rate.set(i, e);
  }
  state.refresh(columns_of(field::face_rate));
}

void ElasticFaces::set_loads(State& state) {
  const Particles& p = state.particles;
  const auto id = p[field::id];
  const auto sum = symmetric_columns(p, field::face_load);
  const Faces is_face(state);
  load_.assign(p.size(), {});
  std::vector<char> loaded(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_face(i)) continue;
    loaded[i] = 1;
    for (const Bond& b : state.bonds.of(static_cast<std::size_t>(id[i]))) loaded[p.row(b.other)] = 1;
  }
  bonded_.clear();
  for (std::uint32_t i = 0; i < p.size(); ++i)
    if (loaded[i]) bonded_.push_back(i);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_face(i) || !state.owns(i)) continue;
    const Matrix3 F = motion_of(state, i, 0.0).F;
    load_[static_cast<std::size_t>(id[i])] =
        -0.5 * (full(sum.at(i)) * transposed(inverse(F)) * solid::shape_inverse_of(p, i));
  }
  state.hand_to_ghosts(load_);
}

void ElasticFaces::add_forces(State& state, const Rows& rows) const {
  solid::add_bond_loads(state, rows, bonded_, load_);
}

}  // namespace tripoint::carried_liquid
