// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint {

/// Transport velocity [Adami, Hu, Adams 2013, J. Comput. Phys. 241, 292, (8), (13), (15)]. d = r_j - r_i, w = transport velocity
/// less velocity.
/// Background force per background pressure [m2]: sum (V_i^2 + V_j^2) (W'/r) d, which evens out the particles.
/// Stress force [N]: sum (V_i^2 + V_j^2) 1/2 (A_i + A_j).grad_i W. A = rho v w^T is the momentum that the difference carries.
struct TransportForces {
  static constexpr std::string_view name = "TransportForces";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::density, field::viscous_velocity_x, field::viscous_velocity_y,
                     field::viscous_velocity_z, field::shift_x, field::shift_y, field::shift_z>;
  using adds = Keys<field::background_x, field::background_y, field::background_z, field::transport_force_x,
                    field::transport_force_y, field::transport_force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 6> sum) {
    const V V_i = i[0], rho_i = i[1], vx_i = i[2], vy_i = i[3], vz_i = i[4], wx_i = i[5], wy_i = i[6], wz_i = i[7];
    const V V_j = j[0], rho_j = j[1], vx_j = j[2], vy_j = j[3], vz_j = j[4], wx_j = j[5], wy_j = j[6], wz_j = j[7];
    const V b = where(g.within, (V_i * V_i + V_j * V_j) * g.gradient);
    sum[0] += b * g.dx;
    sum[1] += b * g.dy;
    sum[2] += b * g.dz;
    const V out_i = -0.5 * b * rho_i * (wx_i * g.dx + wy_i * g.dy + wz_i * g.dz);
    const V out_j = -0.5 * b * rho_j * (wx_j * g.dx + wy_j * g.dy + wz_j * g.dz);
    sum[3] += out_i * vx_i + out_j * vx_j;
    sum[4] += out_i * vy_i + out_j * vy_j;
    sum[5] += out_i * vz_i + out_j * vz_j;
  }
};

/// Sums for liquids that the transport velocity moves (model 8.3), d = r_j - r_i.
/// For the mean of the pressure: sum W (p_j - p_i) over liquid neighbours [Pa/m3]. Over all neighbours: sum (W'/r)(v_j - v_i).d
/// [1/(s m3)]. Times -V_i it is the divergence of the velocity, as the rate of the number density has it.
struct TransportMeans {
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::pressure, field::group, field::velocity_x, field::velocity_y, field::velocity_z>;
  using adds = Keys<field::pressure_around, field::nearing>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 5> i, std::span<const V, 5> j, std::span<V, 2> sum) {
    const V p_i = i[0], group_i = i[1], vx_i = i[2], vy_i = i[3], vz_i = i[4];
    const V p_j = j[0], group_j = j[1], vx_j = j[2], vy_j = j[3], vz_j = j[4];
    const V W = g.kernels.wendland.value_inside(g.r);
    sum[0] += where(g.within & (group_i == liquid_group) & (group_j == liquid_group), W * (p_j - p_i));
    sum[1] += where(g.within, g.gradient) * ((vx_j - vx_i) * g.dx + (vy_j - vy_i) * g.dy + (vz_j - vz_i) * g.dz);
  }
};

/// Both in one pass.
struct TransportForcesAndMeans {
  static constexpr std::string_view name = "TransportForcesAndMeans";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::density, field::viscous_velocity_x, field::viscous_velocity_y,
                     field::viscous_velocity_z, field::shift_x, field::shift_y, field::shift_z, field::pressure, field::group,
                     field::velocity_x, field::velocity_y, field::velocity_z>;
  using adds = Keys<field::background_x, field::background_y, field::background_z, field::transport_force_x,
                    field::transport_force_y, field::transport_force_z, field::pressure_around, field::nearing>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 13> i, std::span<const V, 13> j, std::span<V, 8> sum) {
    TransportForces::pair<V>(g, i.template first<8>(), j.template first<8>(), sum.template first<6>());
    TransportMeans::pair<V>(g, i.template last<5>(), j.template last<5>(), sum.template last<2>());
  }
};

}  // namespace tripoint
