// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/carried_terms.hpp"

/// Pair terms of a step of sound, which takes the corrections that an earlier step has formed.
namespace tripoint::carried_liquid {

/// Divergence of the velocity by the pair `own`, and the share of solids, on which the push out of them
/// stands.
struct SoundRate {
  static constexpr std::string_view name = "SoundRate";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::velocity, field::correction>;
  using adds = Keys<field::divergence, field::wall_share>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_j = j(field::impedance), V_j = j(field::carried_volume);
    const V f = where<V>(g.within, -g.gradient * V_j), w = weight<V>(i(field::impedance), z_j);
    sum(field::divergence) +=
        (w * f) * dot(j(field::velocity) - i(field::velocity), i(field::correction) * g.d());
    const MaskOf<V> wall_j = g.within & (z_j == 0.0);
    if (any(wall_j)) sum(field::wall_share) += where<V>(wall_j, V_j * g.kernels.wendland.value_inside(g.r));
  }
};

/// Force of the pressure by the pair `own`; the stress is p V B. At a solid the head between the two is
/// added.
/// @tparam viscous with the viscous force, where it is too stiff to be held
template <bool viscous>
struct SoundForce {
  static constexpr std::string_view name = viscous ? "SoundForceViscous" : "SoundForce";
  static constexpr bool zero_beyond = true;
  using Inviscid = Keys<field::carried_volume, field::impedance, field::stress, field::density,
                        field::pressure, field::pull, field::wall_pressure, field::correction>;
  using Viscous = Keys<field::carried_volume, field::impedance, field::stress, field::density,
                       field::pressure, field::pull, field::wall_pressure, field::correction,
                       field::liquid_viscosity, field::slips, field::predicted>;
  using reads = std::conditional_t<viscous, Viscous, Inviscid>;
  using adds = std::conditional_t<viscous, Keys<field::force, field::viscous_force>, Keys<field::force>>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    const V f = where<V>(g.within, -g.gradient);
    const V a = weight<V>(z_i, z_j) * j(field::carried_volume),
            b = weight<V>(z_j, z_i) * i(field::carried_volume);
    VectorOf<V> t = (a * i(field::stress) + b * j(field::stress)) * g.d();
    if (any((z_i == 0.0) | (z_j == 0.0))) t = plus_head<V>(g, i, j, t);
    sum(field::force) += -f * t;
    if constexpr (viscous) {
      const V mu = viscosity_between<V>(i, j), both = i(field::carried_volume) * j(field::carried_volume);
      sum(field::viscous_force) += shear<V>(g, f * both * mu, j(field::predicted) - i(field::predicted));
    }
  }

 private:
  template <class V>
  [[gnu::always_inline]] static VectorOf<V> plus_head(const PairGeometry<V>& g, const auto& i, const auto& j,
                                                      const VectorOf<V>& t) {
    const MaskOf<V> wall_i = i(field::impedance) == 0.0, wall_j = j(field::impedance) == 0.0;
    const V both = i(field::carried_volume) * j(field::carried_volume);
    const auto [head_i, head_j] = heads<V>(g, i, j);
    const V of_i = where<V>(wall_j & !wall_i, 2.0 * both * head_i),
            of_j = where<V>(wall_i & !wall_j, 2.0 * both * head_j);
    const V out =
        both * (where<V>(wall_j, i(field::wall_pressure)) + where<V>(wall_i, j(field::wall_pressure)));
    return t + (of_i * (i(field::correction) * g.d()) + of_j * (j(field::correction) * g.d())) + out * g.d();
  }
};

}  // namespace tripoint::carried_liquid
