// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid_ledger.hpp"

#include "effects/fluid/fluid_terms.hpp"
#include "effects/ordered_sum.hpp"

namespace tripoint::fluid {
namespace {

enum Entry_ : std::size_t { momentum, angular = 3, kinetic = 6, potential, compression, entries };

void add_vector(std::array<double, entries>& sums, std::size_t first, const Vec3& v) { sums[first] += v.x, sums[first + 1] += v.y, sums[first + 2] += v.z; }

/// Core energy of the pairs of i that act, half of each pair [J].
double core_energy(const World& world, const Triple<const double>& x, std::span<const double> group, const Core& core, std::size_t i) {
  double sum = 0.0;
  for (const Entry e : world.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (acts(group[i], group[j]) == 0.0) continue;
    sum += 0.5 * core.energy(norm((x.at(j) - x.at(i)) + world.neighbours->shift(e.image())));
  }
  return sum;
}

}  // namespace

void add_fluid(const World& world, const SceneNumbers& n, const PairKernels& kernels, Ledger& ledger) {
  const Particles& p = world.particles;
  const bool core = world.scene.mode_of(Term::pressure) == Mode::corrected;
  const auto m = p[field::mass], rho = p[field::density], rest = p[field::rest_density], group = p[field::group];
  const auto x = positions(p), v = velocities(p);
  std::vector<std::array<double, entries>> blocks;
  const auto sums = ordered_sums(p.size(), world.threads, blocks, [&](std::size_t i, std::array<double, entries>& sum) {
    if (core) sum[compression] += core_energy(world, x, group, kernels.core, i);
    const bool borrowed = group[i] == 0.0 && n.extrapolates;  // the pressure of such a wall is the liquid's
    if (!borrowed) sum[compression] += compression_energy(state_of(n, rest[i], world.scene.clamp), m[i], rho[i]);
    if (group[i] >= 0.0) return;
    const Vec3 r = world.unwrapped(i), P = m[i] * v.at(i);
    add_vector(sum, momentum, P);
    add_vector(sum, angular, cross(r, P));
    sum[kinetic] += 0.5 * dot(v.at(i), P);
    sum[potential] -= m[i] * dot(world.scene.gravity, r);
  });
  ledger.momentum += {sums[momentum], sums[momentum + 1], sums[momentum + 2]};
  ledger.angular_momentum += {sums[angular], sums[angular + 1], sums[angular + 2]};
  ledger.energy["kinetic"] += sums[kinetic];
  ledger.energy["potential"] += sums[potential];
  ledger.energy["compression"] += sums[compression];
}

}  // namespace tripoint::fluid
