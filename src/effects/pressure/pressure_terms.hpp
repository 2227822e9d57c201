// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

/// Pair terms of pressure in liquids and in everything that touches, printed and corrected.
/// d = r_j - r_i, so that grad_i W = -(W'/r) d.
namespace tripoint {

/// Pressure force (7) corrected (model 8.3) [N]: F_i = -sum_j (V_i^2 p_i + V_j^2 p_j) grad_i W, the gradient
/// of compression_energy(). `pressure_share` is V^2 p over the kernel's lattice moment, so that p is the
/// force on an area also on the lattice (decision 6). The core energy 1/2 kappa (b - r)^2, b =
/// scene.core_reach dx, is added. It keeps pairs apart where the clamp leaves no repulsion. `solids_alone`:
/// where liquids carry their density.
template <bool solids_alone>
struct PressureCorrectedOf {
  static constexpr std::string_view name = solids_alone ? "PressureOfSolids" : "PressureCorrected";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::pressure_share, field::group>;
  using adds = Keys<field::force>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V share_i = i(field::pressure_share), share_j = j(field::pressure_share);
    const V group_i = i(field::group), group_j = j(field::group);
    const V pressure = (share_i + share_j) * g.gradient;
    MaskOf<V> meet = g.apart & acts(group_i, group_j);
    if constexpr (solids_alone) meet = meet & (group_i != liquid_group) & (group_j != liquid_group);
    const V f = where(meet, pressure - g.kernels.core.force_over_r(g.r, g.per_r2));
    sum(field::force) += f * g.d();
  }
};

using PressureCorrected = PressureCorrectedOf<false>;
using PressureOfSolids = PressureCorrectedOf<true>;

/// Pressure force (7) as printed [N]: F_i = -sum_j V_i V_j (p_i + p_j)/2 grad_i W_spiky, V = m/rho of (4).
/// Its faults: it tends to half of grad p, and a clamped mixture of two kernels does not keep energy in
/// contacts.
struct PressurePaper {
  static constexpr std::string_view name = "PressurePaper";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::pressure, field::group>;
  using adds = Keys<field::force>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V V_i = i(field::volume), p_i = i(field::pressure), group_i = i(field::group);
    const V V_j = j(field::volume), p_j = j(field::pressure), group_j = j(field::group);
    const V share = (0.5 * V_i) * (V_j * (p_i + p_j));
    const V f = where(g.apart & acts(group_i, group_j),
                      share * (g.kernels.spiky.derivative_inside(g.r) * (g.r * g.per_r2)));
    sum(field::force) += f * g.d();
  }
};

}  // namespace tripoint
