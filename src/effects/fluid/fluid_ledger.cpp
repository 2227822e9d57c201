// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid_ledger.hpp"

#include "effects/fluid/fluid_terms.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"
#include "world/ordered_sum.hpp"

namespace tripoint::fluid {
namespace {

/// Core energy of the pairs of i that act, half of each pair [J]. A particle without a list has none.
double core_energy(const World& world, const Triple<const double>& x, std::span<const double> group,
                   const Core& core, const liquid::SumsDensity& sums, std::size_t i) {
  double sum = 0.0;
  for (const Entry e : world.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (e.own() || acts(group[i], group[j]) == 0.0 || !sums(group[j])) continue;
    sum += 0.5 * core.energy(norm((x.at(j) - x.at(i)) + world.neighbours->shift(e.image())));
  }
  return sum;
}

}  // namespace

void add_fluid(const World& world, const liquid::SceneNumbers& n, const PairKernels& kernels,
               Ledger& ledger) {
  const Particles& p = world.particles;
  const bool core = world.scene.mode_of(term::pressure) == Mode::corrected,
             clamps = liquid::clamps(world.scene);
  const auto m = p[field::mass], rho = p[field::density], rest = p[field::rest_density],
             group = p[field::group];
  const auto x = positions(p);
  const liquid::SumsDensity sums(world.scene);
  std::vector<std::array<double, 1>> blocks;
  const auto compression = ordered_sums_of_all(world, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (!sums(group[i])) return;
    if (core && i < world.neighbours->rows()) sum[0] += core_energy(world, x, group, kernels.core, sums, i);
    sum[0] += compression_energy(liquid::state_of(n, group[i], rest[i], clamps), m[i], rho[i]);
  });
  ledger.energy["compression"] += compression[0];
}

}  // namespace tripoint::fluid
