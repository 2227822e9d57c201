// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"

/// Pair terms of walls (model 8.4). d = r_j - r_i.
namespace tripoint {

/// Mean velocity of the liquid at a wall particle [Adami, Hu, Adams 2012]: sums over its liquid neighbours of
/// w and v w. The weight is the viscous coefficient of the pair without the factors that all pairs of the
/// wall particle share. w = mu (-W'/r), and (-W'/r) as `central` weights it. The `laplacian` forces that
/// follow only take energy. Seen from the wall their work is -sum G v_f.(v_f + mean v) = -(sum G v_f^2 + (sum
/// G) |mean v|^2).
template <bool weighted>
struct WallExtrapolationOf {
  static constexpr std::string_view name = weighted ? "WallExtrapolationWeighted" : "WallExtrapolation";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::solid, field::viscosity, field::viscous_velocity>;
  using adds = Keys<field::wall_weight, field::wall_velocity>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V solid_i = i(field::solid), solid_j = j(field::solid), mu_j = j(field::viscosity);
    const V w = where(g.within, (solid_i * (1.0 - solid_j)) * (mu_j * shear_weighted<weighted>(g)));
    sum(field::wall_weight) += w;
    sum(field::wall_velocity) += w * j(field::viscous_velocity);
  }
};
using WallExtrapolation = WallExtrapolationOf<false>;
using WallExtrapolationWeighted = WallExtrapolationOf<true>;

}  // namespace tripoint
