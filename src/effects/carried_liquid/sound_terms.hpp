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
    const V f = middle.slope(g, z_i, z_j) * j(field::carried_volume);
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
    const V V_i = i(field::carried_volume), V_j = j(field::carried_volume), both = V_i * V_j, ff = f * both;
    const VectorOf<V> d = g.d(), t = (V_j * i(field::stress) + V_i * j(field::stress)) * d,
                      v = j(field::predicted) - i(field::predicted);
    sum(field::force) += -f * (t + (both * push_out<V>(i, j, z_i, z_j)) * d);
    sum(field::viscous_force) += shear<V>(g, ff * viscosity_between<V>(i, j), v);
    const MaskOf<V> pressed = (i(field::stress).xx != 0.0) | (j(field::stress).xx != 0.0);
    sum(field::residue_force) += damped<Damping::residue, V>(g, ff, pressed, i, j, v) * d;
  }
};

/// What the rates of strain of elastic solids add to the divergence, where solid and liquid meet halfway.
struct FaceRate {
  static constexpr std::string_view name = "FaceRate";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::predicted, field::correction_halfway,
                     field::face_rate>;
  using adds = Keys<field::divergence>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    const Halfway<V> middle(g, j(field::predicted) - i(field::predicted));
    const MaskOf<V> meet = (z_i == 0.0) != (z_j == 0.0);
    const V f = where<V>(meet, middle.slope(g, z_i, z_j) * j(field::carried_volume));
    const VectorOf<V> strained = (i(field::face_rate) + j(field::face_rate)) * middle.d;
    sum(field::divergence) -= (0.5 * f) * dot(strained, i(field::correction_halfway) * middle.d);
  }
};

/// Loads of the pressure on an elastic solid: of a solid i, sum f (x) d over liquids.
struct FaceLoad {
  static constexpr std::string_view name = "FaceLoad";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::stress>;
  using adds = Keys<field::face_load>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    const V f = where<V>((z_i == 0.0) & (z_j != 0.0), slope_of<V>(g, z_i, z_j));
    const VectorOf<V> d = g.d(), t = (-f) * ((j(field::carried_volume) * i(field::stress) +
                                              i(field::carried_volume) * j(field::stress)) *
                                             d);
    sum(field::face_load) += SymmetricOf<V>{t.x * d.x,
                                            t.y * d.y,
                                            t.z * d.z,
                                            0.5 * (t.y * d.z + t.z * d.y),
                                            0.5 * (t.x * d.z + t.z * d.x),
                                            0.5 * (t.x * d.y + t.y * d.x)};
  }
};

}  // namespace tripoint::carried_liquid
