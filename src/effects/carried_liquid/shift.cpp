// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/shift.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/carried_liquid/fields.hpp"

namespace tripoint::carried_liquid {

void set_shift(State& state, const Scheme& scheme, double sound_speed) {
  Particles& p = state.particles;
  const auto w = triple(p, field::shift);
  const auto s = triple(std::as_const(p), field::unevenness);
  const auto z = p[field::impedance], near = p[field::exposed_near], exposed = p[field::exposed],
             speed2 = p[field::nearby_speed2];
  const double h = 0.5 * state.support();
  const auto driven = p.has(field::driven.name) ? p[field::driven] : std::span<int>{};
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool inside =
        z[i] != 0.0 && (driven.empty() || driven[i] == 0) && exposed[i] == 0.0 && near[i] == 0.0;
    if (!inside || scheme.shift == Shift::none) {
      w.set(i, {});
      continue;
    }
    const Vec3 e = s.at(i);
    const double size2 = h * h * dot(e, e);
    if (scheme.shift == Shift::at_rest) {
      w.set(i, (-scheme.strength * sound_speed * h * std::min(100.0 * size2, 1.0)) * e);
    } else {
      const double u = std::sqrt(speed2[i]), way = scheme.strength * h * u;
      const double most = 0.25 * u, length = way * norm(e);
      w.set(i, (-way * (length > most ? most / length : 1.0)) * e);
    }
  }
}

}  // namespace tripoint::carried_liquid
