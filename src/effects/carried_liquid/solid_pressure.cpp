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

double Squeezes::next(std::size_t i, double modulus, double dt, double rate, double& taken) const {
  const double before = squeeze_[i], touching = touching_[i];
  const double wanted = touching > 1e-12 ? std::max(pressed_[i] / touching, 0.0) / modulus : 0.0;
  if (before < 0.0) return wanted;
  const double carried = (1.0 + before) * std::clamp(1.0 - dt * divergence_[i], 0.5, 2.0);
  const double s = std::max(carried - 1.0, 0.0), next = s + std::min(rate * dt, 1.0) * (wanted - s);
  const double volume = mass_[i] / rest_[i], of_s = 1.0 / ((1.0 + s) * (1.0 + s)),
               of_next = 1.0 / ((1.0 + next) * (1.0 + next));
  // As of a liquid: the mean of both pressures works, half of it by what the draw adds.
  taken += 0.5 * modulus * volume * (s * of_s + next * of_next - of_s * (s - before)) * (next - s);
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
