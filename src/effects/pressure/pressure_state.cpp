// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/pressure_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/machine.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"
#include "state/failure.hpp"
#include "state/rows_loop.hpp"

namespace tripoint::pressure {

void refuse_overlap(const State& state, const liquid::SceneNumbers& n) {
  const Particles& p = state.particles;
  if (!p.has(field::number_density) || is_off(state.scene, GuardName::overlap)) return;
  const auto rho = p[field::density], rest = p[field::rest_density], group = p[field::group];
  const auto pressed = [&](std::size_t i) { return group[i] == wall_group ? 0.0 : rho[i] / rest[i]; };
  double most = 0.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) \
    reduction(max                                                    \
              : most) if (p.moving() > worth_threads)
  for (std::size_t i = 0; i < p.moving(); ++i) most = std::max(most, pressed(i));
  if (most <= n.overlap_density) return;
  std::size_t worst = 0;
  while (pressed(worst) != most) ++worst;
  fail(state, GuardName::overlap, worst, "density", "density",
       fmt::format("is pressed to {:.3g} times its rest density, as where two bodies overlap by one spacing "
                   "({:.3g}): a stiffer "
                   "contact (speed of sound above 10 times that of the "
                   "impact), walls of 3 layers, or a smaller step",
                   most, n.overlap_density));
}

void set_pressure(State& state, const liquid::SceneNumbers& n, const Rows& rows) {
  Particles& p = state.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], pressure = p[field::pressure],
             group = p[field::group];
  const bool paper = state.scene.mode_of(term::state) == Mode::paper, clamps = liquid::clamps(state.scene);
  for_rows(rows, state.threads, [&](std::size_t i) {
    const EquationOfState e = liquid::state_of(n, group[i], rest[i], clamps);
    pressure[i] = paper ? pressure_paper(e, rho[i]) : pressure_corrected(e, rho[i]);
  });
}

void set_pressure_shares(State& state, const liquid::SceneNumbers& n, const Rows& rows) {
  Particles& p = state.particles;
  const auto share = p[field::pressure_share], V = p[field::volume], pressure = p[field::pressure],
             m = p[field::mass], rest = p[field::rest_density];
  const auto group = p[field::group];
  const auto q = p.has(field::bulk_pressure) ? p[field::bulk_pressure] : std::span<double>{};
  // At a free surface a particle has few neighbours, and is not thinned: it presses on its rest volume.
  const auto pressed = [&](std::size_t i) {
    return n.surface_head > 0.0 && group[i] == liquid_group ? std::min(V[i], m[i] / rest[i]) : V[i];
  };
  for_rows(rows, state.threads, [&](std::size_t i) {
    const double volume = pressed(i);
    share[i] = volume * volume * (q.empty() ? pressure[i] : pressure[i] + q[i]) / n.gradient_moment;
  });
}

}  // namespace tripoint::pressure
