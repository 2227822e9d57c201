// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/let_out.hpp"

#include <algorithm>
#include <cmath>

#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"
#include "state/ordered_sum.hpp"
#include "state/rows_loop.hpp"

namespace tripoint::pressure {
namespace {

constexpr double slow = 50.0;     ///< supports that sound passes until 1/e of an excess is left [1]
constexpr double at_last = 20.0;  ///< such times, after which none is left [1]

bool holds_some(const State& state) {
  const auto rest = state.particles[field::rest_density];
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (rest[i] > state.material_of(i).density) return true;
  return false;
}

}  // namespace

bool lets_solids_out(const Scene& s) {
  const auto corrected = [&](const Term& t) { return s.mode_of(t) == Mode::corrected; };
  return corrected(term::density) && corrected(term::pressure) && corrected(term::state) &&
         liquid::clamps(s) && (liquid::carries_density(s) || !s.has_liquid());
}

void take_as_rest(State& state, const Rows& rows) {
  Particles& p = state.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], group = p[field::group];
  for_rows(rows, state.threads, [&](std::size_t i) {
    if (group[i] != liquid_group) rest[i] = std::max(rest[i], rho[i]);
  });
}

double let_out(State& state, const liquid::SceneNumbers& n, double dt) {
  const double all = slow * state.support() / n.sound_speed;
  double& time = state.step_numbers[let_out_for];
  if (time < 0.0 && !holds_some(state)) time = none_let_out;
  if (time >= at_last * all) return 0.0;
  time = std::max(time, 0.0) + dt;
  const double kept = time < at_last * all ? std::exp(-dt / all) : 0.0;
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
    const double before = stored();
    rest[i] = of_material + kept * excess;
    sum[0] += stored() - before;
  })[0];
}

bool has_let_out(const State& state) {
  const double time = state.step_numbers[let_out_for];
  return time < 0.0 ? holds_some(state) : time < none_let_out;
}

}  // namespace tripoint::pressure
