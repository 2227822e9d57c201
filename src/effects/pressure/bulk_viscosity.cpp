// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/bulk_viscosity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "liquids/fields.hpp"
#include "scene/effect_rule.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::pressure {
namespace {

// All three are measured by tests/step/stability_bulk_test.cpp; model 8.10 has the equation of the frontier
// that they stand in.

/// 2 c/(w h) [1], w the frequency of the fastest wave of the lattice at the default h/dx = 2.6.
constexpr double fastest_wave = 0.885;
/// Damping rate of a light liquid beside one of four times its density (damped_density), over its rate alone
/// [1]. It is the greatest measured on layers and on random mixtures.
constexpr double damping_beside_heavy = 2.12;
/// Share of the longest stable step that a step takes [1]: a choice. At the default zeta = 0.2 the bound is
/// then 0.4514 h/c, just above that of sound, 0.45 h/c.
constexpr double share_of_frontier = 0.81;

}  // namespace

double bulk_viscosity(const Scene& scene) { return acting_number(scene, "bulk_viscosity"); }

void set_bulk_pressure(State& state, const liquid::SceneNumbers& n) {
  Particles& p = state.particles;
  const double dt = 2.0 * state.step_numbers[liquid::half_step];  // the step was begun by a half kick
  const bool flows = dt > 0.0 && state.change.empty();            // new particles change densities at once
  // [m2/s] over the step
  const double viscosity = flows ? n.bulk_viscosity * n.sound_speed * state.support() / dt : 0.0;
  const auto delta = p[field::number_density], before = p[field::number_density_before],
             q = p[field::bulk_pressure];
  const auto rest = p[field::rest_density], m = p[field::mass], pressure = p[field::pressure],
             V = p[field::volume], group = p[field::group];
  std::vector<std::array<double, 1>> blocks;
  const auto taken = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    const double squeezed = flows && group[i] == liquid_group ? delta[i] / before[i] - 1.0 : 0.0;
    const double next =
        pressure[i] > 0.0 && V[i] * rest[i] < m[i]
            ? std::max(viscosity * std::min(rest[i], n.damped_density) * squeezed, -pressure[i])
            : 0.0;
    sum[0] += 0.5 * (q[i] + next) * V[i] * squeezed;
    q[i] = next;
    before[i] = delta[i];
  });
  state.accumulated[taken_by_bulk_viscosity] += n.pressure_work * taken[0];
}

double bulk_viscous_step(double zeta) {
  const double of_mixed = damping_beside_heavy * zeta;
  return share_of_frontier * (std::sqrt(of_mixed * of_mixed + fastest_wave * fastest_wave) - of_mixed);
}

}  // namespace tripoint::pressure
