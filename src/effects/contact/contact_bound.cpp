// SPDX-License-Identifier: BSD-3-Clause
#include "effects/contact/contact_bound.hpp"

#include <algorithm>
#include <limits>

#include "core/machine.hpp"
#include "liquids/fields.hpp"

namespace tripoint::contact {
namespace {

/// Compression that counts as round-off [1]: far above that of a kernel sum, and 1e-9 of the stiffness as a
/// pressure.
constexpr double rounding = 1e-9;

/// Steps of sound before a touch from which on the bound of contact holds [1]: a choice. In them a hit at a
/// tenth of the speed of sound comes nearer by a third of a spacing.
constexpr double looked_ahead = 3.0;

}  // namespace

TimeStepBound contact_bound(const State& state, const liquid::SceneNumbers& n, double length, double speed) {
  const double sound = length / (n.sound_speed + speed), contact = length / (n.contact_speed + speed);
  if (n.contact_step == 0.0) return {contact, "contact"};
  if (state.step_numbers[time_to_touch] > looked_ahead * sound) return {};
  return {n.contact_step * contact, "contact"};
}

void update_time_to_touch(State& state, const liquid::SceneNumbers& n) {
  Particles& p = state.particles;
  const double dt = 2.0 * state.step_numbers[liquid::half_step];  // the step was begun by a half kick
  const auto delta = p[field::number_density], before = p[field::solid_density_before];
  const auto rest = p[field::rest_density], m = p[field::mass], group = p[field::group];
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) num_threads(state.threads) \
    reduction(min                                                    \
              : least) if (p.moving() > worth_threads)
  for (std::size_t i = 0; i < p.moving(); ++i) {
    const double missing = rest[i] / m[i] * n.lattice_density * (1.0 + rounding) - delta[i],
                 gained = delta[i] - before[i];
    before[i] = delta[i];
    if (group[i] == liquid_group || !state.owns(i)) continue;
    if (missing <= 0.0) least = 0.0;
    if (gained > 0.0) least = std::min(least, missing / gained * dt);
  }
  state.step_numbers[time_to_touch] = std::max(0.0, least);
}

void forget_time_to_touch(State& state) {
  std::ranges::fill(state.particles[field::solid_density_before], -std::numeric_limits<double>::infinity());
}

}  // namespace tripoint::contact
