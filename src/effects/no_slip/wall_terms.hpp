// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"

/// Pair terms of walls (model 8.4). d = r_j - r_i.
namespace tripoint {

/// Mean velocity of the liquid at a wall particle [Adami, Hu, Adams 2012]: sums over its liquid neighbours of w and v w. The
/// weight is the viscous coefficient of the pair without the factors that all pairs of the wall particle share. w = mu (-W'/r),
/// and (-W'/r) as `central` weights it. The `laplacian` forces that follow only take energy. Seen from the wall their work is
/// -sum G v_f.(v_f + mean v) = -(sum G v_f^2 + (sum G) |mean v|^2).
template <bool weighted>
struct WallExtrapolationOf {
  static constexpr std::string_view name = weighted ? "WallExtrapolationWeighted" : "WallExtrapolation";
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::solid, field::viscosity, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z>;
  using adds = Keys<field::wall_weight, field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 5> i, std::span<const V, 5> j, std::span<V, 4> sum) {
    const V solid_i = i[0], solid_j = j[0], mu_j = j[1], vx_j = j[2], vy_j = j[3], vz_j = j[4];
    const V w = where(g.within, (solid_i * (1.0 - solid_j)) * (mu_j * shear_weighted<weighted>(g)));
    sum[0] += w;
    sum[1] += w * vx_j;
    sum[2] += w * vy_j;
    sum[3] += w * vz_j;
  }
};
using WallExtrapolation = WallExtrapolationOf<false>;
using WallExtrapolationWeighted = WallExtrapolationOf<true>;

}  // namespace tripoint
