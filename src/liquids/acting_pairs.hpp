// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "pairs/pass.hpp"
#include "particles/catalogue.hpp"

namespace tripoint {

/// Where a pair acts: not where both are members of one rigid body, or both are wall.
template <class V>
[[nodiscard]] inline MaskOf<V> acts(V group_i, V group_j) noexcept {
  return (group_j < wall_group) | (group_i != group_j);
}

/// -W'/r [1/m5], as `central` viscosity weights it for isotropic shear where it does (model 8.5).
template <bool weighted, class V>
[[nodiscard, gnu::always_inline]] inline V shear_weighted(const PairGeometry<V>& g) noexcept {
  if constexpr (weighted)
    return g.kernels.shear.weighted(-g.gradient, g.r2);
  else
    return -g.gradient;
}

}  // namespace tripoint
