// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/solid_pressure.hpp"

#include <algorithm>

#include "effects/carried_liquid/fields.hpp"

namespace tripoint::carried_liquid {
namespace {

constexpr double least_share = 1e-12;  ///< of liquid around a solid that has a pressure

}  // namespace

void set_displaced(State& state) {
  Particles& p = state.particles;
  const auto z = p[field::impedance], V = p[field::carried_volume], divergence = p[field::divergence],
             touching = p[field::touching_halfway], pressure = p[field::carried_pressure],
             displaced = p[field::displaced];
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool pressed = z[i] == 0.0 && touching[i] > least_share && pressure[i] > 0.0;
    displaced[i] = pressed ? V[i] * divergence[i] / touching[i] : 0.0;
  }
}

void set_solid_pressure(State& state) {
  Particles& p = state.particles;
  const auto z = p[field::impedance], touching = p[field::touching], pressed = p[field::pressed],
             weighed = p[field::weighed], pressure = p[field::carried_pressure];
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i)
    if (z[i] == 0.0)
      pressure[i] = touching[i] > least_share ? std::max((pressed[i] + weighed[i]) / touching[i], 0.0) : 0.0;
}

void keep_pressure(State& state, const CarriedState& equation, std::size_t i, bool was_liquid) {
  Particles& p = state.particles;
  if (was_liquid || p[field::impedance][i] == 0.0) return;
  p[field::density][i] =
      p[field::liquid_rest_density][i] * (1.0 + p[field::carried_pressure][i] / equation.modulus);
}

}  // namespace tripoint::carried_liquid
