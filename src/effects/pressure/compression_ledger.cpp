// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/compression_ledger.hpp"

#include "effects/pressure/pressure_terms.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "liquids/let_out.hpp"
#include "scene/shared_terms.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::pressure {
namespace {

/// Core energy of the pairs of i that act, half of each pair [J]. A particle without a list has none.
double core_energy(const State& state, const Triple<const double>& x, std::span<const double> group,
                   const Core& core, const liquid::SumsDensity& sums, std::size_t i) {
  double sum = 0.0;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (e.own() || acts(group[i], group[j]) == 0.0 || !sums(group[j])) continue;
    sum += 0.5 * core.energy(norm((x.at(j) - x.at(i)) + state.neighbours->shift(e.image())));
  }
  return sum;
}

}  // namespace

double core_energy(const State& state, const liquid::SceneNumbers& n, double share) {
  if (state.scene.mode_of(term::pressure) != Mode::corrected || share == 0.0) return 0.0;
  const Core core{share * n.core_stiffness, n.core_reach};
  const auto group = state.particles[field::group];
  const auto x = positions(std::as_const(state.particles));
  const liquid::SumsDensity sums(state.scene);
  std::vector<std::array<double, 1>> blocks;
  return ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (sums(group[i]) && i < state.neighbours->rows()) sum[0] += core_energy(state, x, group, core, sums, i);
  })[0];
}

void add_compression(const State& state, const liquid::SceneNumbers& n, Ledger& ledger) {
  const Particles& p = state.particles;
  const bool core_acts = state.scene.mode_of(term::pressure) == Mode::corrected,
             clamps = liquid::clamps(state.scene);
  const auto m = p[field::mass], rho = p[field::density], rest = p[field::rest_density],
             group = p[field::group];
  const auto x = positions(p);
  const Core core{liquid::core_share(state, n) * n.core_stiffness, n.core_reach};
  const liquid::SumsDensity sums(state.scene);
  std::vector<std::array<double, 1>> blocks;
  const auto compression = ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (!sums(group[i])) return;
    if (core_acts && i < state.neighbours->rows()) sum[0] += core_energy(state, x, group, core, sums, i);
    sum[0] += compression_energy(liquid::state_of(n, group[i], rest[i], clamps), m[i], rho[i]);
  });
  ledger.energy["compression"] += compression[0];
}

}  // namespace tripoint::pressure
