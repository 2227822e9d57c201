// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/shift.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/counter_noise.hpp"
#include "effects/carried_liquid/fields.hpp"

namespace tripoint::carried_liquid {
namespace {

constexpr double full_strain = 0.05;  ///< h |strain rate|/c from which the shift has its full strength [1]
/// A lattice that is strained along its own axes lies evenly by symmetry, until it is strings. So straining
/// sets each particle off by this share of h, where h |e| is less.
constexpr double set_off = 0.05;

double size_of(const Symmetric& a) { return std::sqrt(2.0 * contraction(a, a)); }

/// A vector of the particle's own, within the scene's space.
Vec3 own_direction(std::size_t id, bool planar) {
  return {counter_noise(0, id, 0), planar ? 0.0 : counter_noise(0, id, 1), counter_noise(0, id, 2)};
}

}  // namespace

void set_shift(State& state, const Scheme& scheme, double sound_speed) {
  Particles& p = state.particles;
  const auto w = triple(p, field::shift);
  const auto s = triple(std::as_const(p), field::unevenness);
  const auto z = p[field::impedance], near = p[field::exposed_near], exposed = p[field::exposed],
             speed2 = p[field::nearby_speed2];
  const auto strain = symmetric_columns(std::as_const(p), field::strain_rate);
  const auto id = p[field::id];
  const bool planar = state.scene.is_planar();
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
    if (scheme.shift == Shift::by_sound) {
      const double strained =
          std::min(h * size_of(deviator(strain.at(i))) / (full_strain * sound_speed), 1.0);
      const double most = scheme.strength * sound_speed;
      w.set(i, (-most * h * std::max(std::min(100.0 * size2, 1.0), strained)) * e +
                   (most * strained * std::max(set_off - std::sqrt(size2), 0.0)) *
                       own_direction(static_cast<std::size_t>(id[i]), planar));
    } else {
      const double u = std::sqrt(speed2[i]), way = scheme.strength * h * u;
      const double most = 0.25 * u, length = way * norm(e);
      w.set(i, (-way * (length > most ? most / length : 1.0)) * e);
    }
  }
}

}  // namespace tripoint::carried_liquid
