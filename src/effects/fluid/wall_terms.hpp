// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/defect.hpp"
#include "sph/pass.hpp"

/// Pair terms of extrapolating walls (model 8.4). d = r_j - r_i.
namespace tripoint {

/// What a wall particle sees of the liquid (model 8.4) [Adami, Hu, Adams 2012]: sums over liquid neighbours that are not wall
/// of W, p W, rho (r_w - r_f) W and v W.
struct WallExtrapolation {
  using reads = Keys<field::solid, field::pressure, field::density, field::velocity_x, field::velocity_y, field::velocity_z>;
  using adds = Keys<field::wall_weight, field::wall_pressure, field::wall_lever_x, field::wall_lever_y, field::wall_lever_z,
                    field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 6> i, std::span<const V, 6> j, std::span<V, 8> sum) {
    const V w = i[0] * (1.0 - j[0]) * g.kernels.wendland.value_inside(g.r);
    sum[0] += w;
    sum[1] += w * j[1];
    sum[2] -= w * j[2] * g.dx;
    sum[3] -= w * j[2] * g.dy;
    sum[4] -= w * j[2] * g.dz;
    sum[5] += w * j[3];
    sum[6] += w * j[4];
    sum[7] += w * j[5];
  }
};

/// The part of PressureCorrected that comes from the pressure of walls [N]: +V_w^2 p_w (W'/r) d on the liquid, and the opposite
/// on the wall.
struct WallPressureForce {
  using reads = Keys<field::pressure_share, field::group>;
  using adds = Keys<field::wall_force_x, field::wall_force_y, field::wall_force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 2> i, std::span<const V, 2> j, std::span<V, 3> sum) {
    const MaskOf<V> from_i = (i[1] == 0.0) & (j[1] < 0.0), from_j = (j[1] == 0.0) & (i[1] < 0.0);
    const V f = (where(from_i, i[0]) + where(from_j, j[0])) * g.gradient;
    sum[0] += f * g.dx;
    sum[1] += f * g.dy;
    sum[2] += f * g.dz;
  }
};

}  // namespace tripoint
