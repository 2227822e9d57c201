// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/carried_terms.hpp"

/// Pair terms of a step of sound, which takes the corrections that an earlier step has formed.
namespace tripoint::carried_liquid {

/// C d of a symmetric C: xx, yy, zz, yz, xz, xy.
template <class V>
[[gnu::always_inline]] inline Way<V> applied(const std::array<V, 6>& c, const PairGeometry<V>& g) {
  return {c[0] * g.dx + c[5] * g.dy + c[4] * g.dz, c[5] * g.dx + c[1] * g.dy + c[3] * g.dz,
          c[4] * g.dx + c[3] * g.dy + c[2] * g.dz};
}

/// Divergence of the velocity by the pair `own`, and the share of solids, on which the push out of them stands.
struct SoundRate {
  static constexpr std::string_view name = "SoundRate";
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::carried_volume, field::impedance, field::velocity_x, field::velocity_y, field::velocity_z, field::correction_xx,
           field::correction_yy, field::correction_zz, field::correction_yz, field::correction_xz, field::correction_xy>;
  using adds = Keys<field::divergence, field::wall_share>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 11> i, std::span<const V, 11> j, std::span<V, 2> sum) {
    const V f = where<V>(g.within, -g.gradient * j[0]), w = weight<V>(i[1], j[1]);
    const V vx = j[2] - i[2], vy = j[3] - i[3], vz = j[4] - i[4];
    const Way<V> X = corrected<V>(i, 5, g);
    sum[0] += (w * f) * (vx * X.x + vy * X.y + vz * X.z);
    const MaskOf<V> wall_j = g.within & (j[1] == 0.0);
    if (any(wall_j)) sum[1] += where<V>(wall_j, j[0] * g.kernels.wendland.value_inside(g.r));
  }
};

/// Force of the pressure by the pair `own`; the stress is p V B. At a solid the head between the two is added.
/// @tparam viscous with the viscous force, where it is too stiff to be held
template <bool viscous>
struct SoundForce {
  static constexpr std::string_view name = viscous ? "SoundForceViscous" : "SoundForce";
  static constexpr bool zero_beyond = true;
  static constexpr std::size_t count = viscous ? 25 : 20, sums = viscous ? 6 : 3;
  using Inviscid = Keys<field::carried_volume, field::impedance, field::stress_xx, field::stress_yy, field::stress_zz,
                        field::stress_yz, field::stress_xz, field::stress_xy, field::density, field::pressure, field::pull_x,
                        field::pull_y, field::pull_z, field::wall_pressure, field::correction_xx, field::correction_yy,
                        field::correction_zz, field::correction_yz, field::correction_xz, field::correction_xy>;
  using Viscous = Keys<field::carried_volume, field::impedance, field::stress_xx, field::stress_yy, field::stress_zz,
                       field::stress_yz, field::stress_xz, field::stress_xy, field::density, field::pressure, field::pull_x,
                       field::pull_y, field::pull_z, field::wall_pressure, field::correction_xx, field::correction_yy,
                       field::correction_zz, field::correction_yz, field::correction_xz, field::correction_xy,
                       field::liquid_viscosity, field::slips, field::predicted_x, field::predicted_y, field::predicted_z>;
  using reads = std::conditional_t<viscous, Viscous, Inviscid>;
  using adds = std::conditional_t<viscous,
                                  Keys<field::force_x, field::force_y, field::force_z, field::viscous_force_x,
                                       field::viscous_force_y, field::viscous_force_z>,
                                  Keys<field::force_x, field::force_y, field::force_z>>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, count> i, std::span<const V, count> j, std::span<V, sums> sum) {
    const V z_i = i[1], z_j = j[1];
    const V f = where<V>(g.within, -g.gradient);
    const V a = weight<V>(z_i, z_j) * j[0], b = weight<V>(z_j, z_i) * i[0];
    const std::array<V, 6> C{a * i[2] + b * j[2], a * i[3] + b * j[3], a * i[4] + b * j[4],
                             a * i[5] + b * j[5], a * i[6] + b * j[6], a * i[7] + b * j[7]};
    Way<V> t = applied<V>(C, g);
    const MaskOf<V> wall_i = z_i == 0.0, wall_j = z_j == 0.0;
    if (any(wall_i | wall_j)) t = plus_head<V>(g, i, j, t);
    sum[0] -= f * t.x;
    sum[1] -= f * t.y;
    sum[2] -= f * t.z;
    if constexpr (viscous) {
      const V mu = pair_viscosity<V>(z_i, z_j, i[20], j[20], i[21], j[21]);
      add_shear<V>(g, f * (i[0] * j[0]) * mu, {j[22] - i[22], j[23] - i[23], j[24] - i[24]}, sum.template subspan<3, 3>());
    }
  }

 private:
  template <class V>
  [[gnu::always_inline]] static Way<V> plus_head(const PairGeometry<V>& g, std::span<const V, count> i,
                                                 std::span<const V, count> j, const Way<V>& t) {
    const MaskOf<V> wall_i = i[1] == 0.0, wall_j = j[1] == 0.0;
    const V towards = wall_i ? every_lane<V>(-1.0) : every_lane<V>(1.0), both = i[0] * j[0];
    const V lean = towards * ((i[10] + j[10]) * g.dx + (i[11] + j[11]) * g.dy + (i[12] + j[12]) * g.dz);
    const V head_i = where<V>(wall_j & !wall_i, 2.0 * both * head<V>(i[9], i[8] * lean));
    const V head_j = where<V>(wall_i & !wall_j, 2.0 * both * head<V>(j[9], j[8] * lean));
    const V out = both * (where<V>(wall_j, i[13]) + where<V>(wall_i, j[13]));
    const Way<V> h = mixed<V>(head_i, corrected<V>(i, 14, g), head_j, corrected<V>(j, 14, g));
    return {t.x + h.x + out * g.dx, t.y + h.y + out * g.dy, t.z + h.z + out * g.dz};
  }
};

}  // namespace tripoint::carried_liquid
