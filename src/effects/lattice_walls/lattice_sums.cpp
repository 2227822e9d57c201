// SPDX-License-Identifier: BSD-3-Clause
#include "effects/lattice_walls/lattice_sums.hpp"

#include "liquids/fields.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace tripoint::lattice_walls {
namespace {

bool is_liquid(double group) { return group == liquid_group; }

}  // namespace

/// Where the lattices of fixed walls lie: the mean, as of angles, of the places of each wall over the
/// spacing. The mean jitter of all particles of a wall stays in it, which moves the wall as a whole and is no
/// roughness.
void LatticeSums::find_moves(State& state) {
  using std::numbers::pi;
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto body = p[field::body], source = p[field::source], id = p[field::id];
  const auto x = positions(p);
  const double dx = state.scene.spacing;
  const auto fixed = [&](std::size_t row) {
    return group[row] == wall_group &&
           state.bodies[field::body_motion][static_cast<std::size_t>(body[row])] ==
               static_cast<int>(Motion::fixed);
  };
  const auto first_of = [&](std::size_t row) { return 6 * static_cast<std::size_t>(source[row]); };
  std::vector<double> sums(6 * state.scene.bodies.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t a = 0; a < 3 && fixed(i) && state.owns(i); ++a) {
      const double angle = 2.0 * pi * x.at(i)[a] / dx;
      sums[first_of(i) + 2 * a] += std::cos(angle);
      sums[first_of(i) + 2 * a + 1] += std::sin(angle);
    }
  state.add_up(sums);
  moves_.assign(p.size(), {});
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t a = 0; a < 3 && fixed(i); ++a) {
      const double* sum = &sums[first_of(i) + 2 * a];
      const double place = x.at(i)[a] / dx - std::atan2(sum[1], sum[0]) / (2.0 * pi);
      moves_[static_cast<std::size_t>(id[i])][a] = dx * liquid::to_a_millionth(std::round(place) - place);
    }
}

void LatticeSums::find(State& state) {
  if (!pairs_.renew(state.neighbours->rebuilds())) return;
  if (moves_.empty()) find_moves(state);
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto id = p[field::id];
  const auto move = [&](std::size_t row) { return moves_[static_cast<std::size_t>(id[row])]; };
  for (std::uint32_t i = 0; i < p.awake(); ++i) {
    const bool liquid = is_liquid(group[i]);
    if (!liquid && move(i) == Vec3{}) continue;
    for (const Entry e : state.neighbours->of(i)) {
      const auto j = static_cast<std::uint32_t>(e.row());
      if (liquid == is_liquid(group[j])) continue;
      if (const Vec3 added = move(j) - move(i); added != Vec3{}) pairs_.add({j, e.image(), added});
    }
    if (pairs_.has_open_row()) pairs_.end_row(i);
  }
}

/// Calls give(i, j, d, d') for the pairs of each row within the support, in the order of its list. d' is d
/// plus the lattice's part.
template <class Give>
void LatticeSums::each_pair(const State& state, Give give) const {
  const auto x = positions(state.particles);
  const double support = state.support();
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    for (const Pair& pair : pairs_.of(n)) {
      const Vec3 d = liquid::way_to(*state.neighbours, x, i, pair);
      if (norm(d) < support) give(i, pair.row, d, d + pair.added);
    }
  });
}

void LatticeSums::lay_densities(State& state, const PairKernels& kernels) {
  find(state);
  const auto delta = state.particles[field::number_density];
  each_pair(state, [&](std::size_t i, std::size_t, const Vec3& d, const Vec3& from_lattice) {
    delta[i] += kernels.wendland.value(norm(from_lattice)) - kernels.wendland.value(norm(d));
  });
}

void LatticeSums::lay_forces(State& state, const PairKernels& kernels, const Rows& rows) {
  Particles& p = state.particles;
  const auto share = std::as_const(p)[field::pressure_share];
  const auto F = triple(p, field::force);
  each_pair(state, [&](std::size_t i, std::size_t j, const Vec3& d, const Vec3& from_lattice) {
    if (!rows.has(i)) return;
    const double pressure = share[i] + share[j];
    F.set(i, F.at(i) + pressure * (kernels.wendland.derivative_over_r(norm(from_lattice)) * from_lattice -
                                   kernels.wendland.derivative_over_r(norm(d)) * d));
  });
}

}  // namespace tripoint::lattice_walls
