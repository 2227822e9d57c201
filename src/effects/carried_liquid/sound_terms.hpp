// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/carried_terms.hpp"

/// Pair terms of a step of sound, which takes the gradients that an earlier step has formed.
namespace tripoint::carried_liquid {

/// Divergence of the velocity by the pair `own`, and the share of solids.
struct SoundRate {
  static constexpr std::string_view name = "SoundRate";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::predicted, field::correction_halfway>;
  using adds = Keys<field::divergence, field::wall_share, field::touching, field::touching_halfway>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    const VectorOf<V> v = j(field::predicted) - i(field::predicted);
    const Halfway<V> middle(g, v);
    const V f = middle.slope(g, z_i, z_j) * j(field::carried_volume) * weight<V>(z_i, z_j);
    sum(field::divergence) += f * dot(v, i(field::correction_halfway) * middle.d);
    add_shares<V>(g, middle, z_i, z_j, j(field::carried_volume), sum);
  }
};

/// Forces of a step of sound: of the pressure by the pair `own`, where the stress is p V B,
/// of viscosity, and of the residue that the held strain rates leave.
struct SoundForce {
  static constexpr std::string_view name = "SoundForce";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::stress, field::wall_pressure,
                     field::liquid_viscosity, field::slips, field::predicted, field::strain_rate,
                     field::liquid_rest_density>;
  using adds = Keys<field::force, field::viscous_force, field::residue_force>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance), f = slope_of<V>(g, z_i, z_j);
    const V a = weight<V>(z_i, z_j) * j(field::carried_volume),
            b = weight<V>(z_j, z_i) * i(field::carried_volume);
    const V both = i(field::carried_volume) * j(field::carried_volume), ff = f * both;
    const VectorOf<V> d = g.d(), t = (a * i(field::stress) + b * j(field::stress)) * d,
                      v = j(field::predicted) - i(field::predicted);
    sum(field::force) += -f * (t + (both * push_out<V>(i, j, z_i, z_j)) * d);
    sum(field::viscous_force) += shear<V>(g, ff * viscosity_between<V>(i, j), v);
    const MaskOf<V> pressed = (i(field::stress).xx != 0.0) | (j(field::stress).xx != 0.0);
    sum(field::residue_force) += damped<Damping::residue, V>(g, ff, pressed, i, j, v) * d;
  }
};

}  // namespace tripoint::carried_liquid
