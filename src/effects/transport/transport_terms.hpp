// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint {

/// Transport velocity [Adami, Hu, Adams 2013, J. Comput. Phys. 241, 292, (8), (13), (15)]. d = r_j - r_i, w =
/// transport velocity less velocity. Background force per background pressure [m2]: sum (V_i^2 + V_j^2)
/// (W'/r) d, which evens out the particles. Stress force [N]: sum (V_i^2 + V_j^2) 1/2 (A_i + A_j).grad_i W. A
/// = rho v w^T is the momentum that the difference carries.
struct TransportForces {
  static constexpr std::string_view name = "TransportForces";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::density, field::viscous_velocity, field::shift>;
  using adds = Keys<field::background, field::transport_force>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V V_i = i(field::volume), rho_i = i(field::density);
    const V V_j = j(field::volume), rho_j = j(field::density);
    const VectorOf<V> v_i = i(field::viscous_velocity), w_i = i(field::shift);
    const VectorOf<V> v_j = j(field::viscous_velocity), w_j = j(field::shift);
    const V b = where(g.within, (V_i * V_i + V_j * V_j) * g.gradient);
    sum(field::background) += b * g.d();
    const V out_i = -0.5 * b * rho_i * dot(w_i, g.d());
    const V out_j = -0.5 * b * rho_j * dot(w_j, g.d());
    sum(field::transport_force) += out_i * v_i + out_j * v_j;
  }
};

/// Sums for liquids that the transport velocity moves (model 8.3), d = r_j - r_i.
/// For the mean of the pressure: sum W (p_j - p_i) over liquid neighbours [Pa/m3]. Over all neighbours: sum
/// (W'/r)(v_j - v_i).d [1/(s m3)]. Times -V_i it is the divergence of the velocity, as the rate of the number
/// density has it.
struct TransportMeans {
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::pressure, field::group, field::velocity>;
  using adds = Keys<field::pressure_around, field::nearing>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V p_i = i(field::pressure), group_i = i(field::group);
    const V p_j = j(field::pressure), group_j = j(field::group);
    const V W = g.kernels.wendland.value_inside(g.r);
    sum(field::pressure_around) +=
        where(g.within & (group_i == liquid_group) & (group_j == liquid_group), W * (p_j - p_i));
    sum(field::nearing) += where(g.within, g.gradient) * dot(j(field::velocity) - i(field::velocity), g.d());
  }
};

/// Both in one pass.
struct TransportForcesAndMeans {
  static constexpr std::string_view name = "TransportForcesAndMeans";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::density, field::viscous_velocity, field::shift, field::pressure,
                     field::group, field::velocity>;
  using adds = Keys<field::background, field::transport_force, field::pressure_around, field::nearing>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    TransportForces::pair<V>(g, i, j, sum);
    TransportMeans::pair<V>(g, i, j, sum);
  }
};

}  // namespace tripoint
