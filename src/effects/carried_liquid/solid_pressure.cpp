// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/solid_pressure.hpp"

#include <algorithm>

#include "effects/carried_liquid/fields.hpp"

namespace tripoint::carried_liquid {

Squeezes::Squeezes(const State& state)
    : squeeze_(state.particles[field::squeeze]),
      touching_(state.particles[field::touching]),
      pressed_(state.particles[field::pressed]),
      divergence_(state.particles[field::divergence]),
      mass_(state.particles[field::mass]),
      rest_(state.particles[field::liquid_rest_density]) {}

double Squeezes::next(std::size_t i, const CarriedState& equation, double dt, double rate,
                      double& taken) const {
  const double before = squeeze_[i], touching = touching_[i];
  const double wanted = touching > 1e-12 ? std::max(pressed_[i] / touching, 0.0) / equation.modulus : 0.0;
  if (before < 0.0) return wanted;
  const double carried = (1.0 + before) * std::clamp(1.0 - dt * divergence_[i], 0.5, 2.0);
  const double s = std::max(carried - 1.0, 0.0), next = s + std::min(rate * dt, 1.0) * (wanted - s);
  const double rest = rest_[i];
  taken += equation.added(mass_[i], rest, {rest * (1.0 + before), rest * (1.0 + s), rest * (1.0 + next)});
  return next;
}

void keep_pressure(State& state, std::size_t i, bool was_liquid) {
  Particles& p = state.particles;
  const bool is_liquid = p[field::impedance][i] != 0.0;
  const double rest = p[field::liquid_rest_density][i];
  double &rho = p[field::density][i], &squeeze = p[field::squeeze][i];
  if (was_liquid && !is_liquid) squeeze = std::max(rho / rest - 1.0, 0.0);
  if (is_liquid && !was_liquid) rho = rest * (1.0 + std::max(squeeze, 0.0));
}

}  // namespace tripoint::carried_liquid
