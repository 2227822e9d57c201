// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/let_out.hpp"

#include <algorithm>
#include <string>

#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"
#include "state/ordered_sum.hpp"
#include "state/rows_loop.hpp"

namespace tripoint::pressure {
namespace {

/// Excess of density from which on the core is let out, over that of two layers in one plane [1]: a tenth of
/// a spacing. Below it, as where places are jittered, the core presses a little.
constexpr double core_from = 0.05;

bool are_above(const State& state, double share) {
  const auto rest = state.particles[field::rest_density];
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (rest[i] > share * state.material_of(i).density) return true;
  return false;
}

}  // namespace

void take_as_rest(State& state, const Rows& rows) {
  Particles& p = state.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], group = p[field::group];
  for_rows(rows, state.threads, [&](std::size_t i) {
    if (group[i] != liquid_group) rest[i] = std::max(rest[i], rho[i]);
  });
}

bool has_let_out(const State& state) {
  return state.step_numbers[liquid::let_out_for] < liquid::none_let_out;
}

void begin_letting_out(State& state, const liquid::SceneNumbers& n) {
  const auto begin = [&](const StepNumber& number, bool here) {
    double time = here ? 0.0 : liquid::none_let_out;
    std::string unused;
    if (state.halo) state.halo->take_least(time, unused);
    state.step_numbers[number] = time;
  };
  begin(liquid::let_out_for, are_above(state, 1.0));
  begin(liquid::core_let_out_for, are_above(state, 1.0 + core_from * (n.overlap_density - 1.0)));
}

double let_out(State& state, const liquid::SceneNumbers& n, double dt) {
  double& time = state.step_numbers[liquid::let_out_for];
  const double before = liquid::overlap_left(state, n, time);
  if (before == 0.0) return 0.0;
  time += dt;
  if (double& core = state.step_numbers[liquid::core_let_out_for]; core < liquid::none_let_out) core += dt;
  const double kept = liquid::overlap_left(state, n, time) / before;
  Particles& p = state.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], m = p[field::mass],
             group = p[field::group];
  const bool clamps = liquid::clamps(state.scene);
  std::vector<std::array<double, 1>> blocks;
  return ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    const double of_material = state.material_of(i).density, excess = rest[i] - of_material;
    if (!(excess > 0.0)) return;
    const auto stored = [&] {
      return compression_energy(liquid::state_of(n, group[i], rest[i], clamps), m[i], rho[i]);
    };
    const double held = stored();
    rest[i] = of_material + kept * excess;
    sum[0] += stored() - held;
  })[0];
}

}  // namespace tripoint::pressure
