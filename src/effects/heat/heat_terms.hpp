// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/heat/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint {

/// Conduction (21) as printed: dT_i/dt = c_i sum_j (m_j/rho_j) (T_j - T_i) lap W_visc(r_ij) [K/s].
/// Its faults: on the lattice its rate has a floor, 0.93 of the exact one at h/dx = 2.12 whatever the number
/// of particles. Where density or conductivity jump, it keeps sum V T, not energy.
struct HeatFlowPaper {
  static constexpr std::string_view name = "HeatFlowPaper";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::temperature, field::diffusivity>;
  using adds = Keys<field::temperature_rate, field::exchange>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V V_j = j(field::volume), T_j = j(field::temperature), T_i = i(field::temperature),
            c_i = i(field::diffusivity);
    const V a = where(g.within, c_i * V_j * g.kernels.viscosity.laplacian_inside(g.r));
    sum(field::temperature_rate) += a * (T_j - T_i);
    sum(field::exchange) += a;
  }
};

/// Sums Q_i and S_i over neighbours that conduct (model 8.6): what does not is as good as none.
struct HeatMoment {
  static constexpr std::string_view name = "HeatMoment";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::rest_volume, field::conductivity>;
  using adds = Keys<field::spread, field::spread_rest, field::lean>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto& j, auto& sum) {
    const V V_j = j(field::rest_volume), k_j = j(field::conductivity), zero{};
    const V w = where(g.within, where<V>(k_j > zero, V_j * -g.gradient));  // 1/2 V_j K
    const VectorOf<V> d = g.d();
    const SymmetricOf<V> e = g.per_r2 * square(d);
    const V xx = w * (d.x * d.x), yy = w * (d.y * d.y), zz = w * (d.z * d.z);
    sum(field::spread) += xx * e;
    sum(field::spread_rest) += MatrixOf<V>{
        {yy * e.yy, yy * e.zz, yy * e.yz, yy * e.xz, yy * e.xy, zz * e.zz, zz * e.yz, zz * e.xz, zz * e.xy}};
    sum(field::lean) += (2.0 * w) * d;
  }
};

/// Conduction between i and j, (21) corrected (model 8.6) [W]: equal and opposite for each pair, so that sum
/// H is kept. It is G_ij (T_j - T_i), G_ij = V_i V_j [2 k_i k_j/(k_i + k_j)] [1/2 e^T (B_i + B_j) e] K, at
/// least 0.
struct HeatFlowCorrected {
  static constexpr std::string_view name = "HeatFlowCorrected";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::rest_volume, field::conductivity, field::temperature, field::moment_inverse>;
  using adds = Keys<field::heat_rate, field::conductance>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V V_i = i(field::rest_volume), k_i = i(field::conductivity), T_i = i(field::temperature);
    const V V_j = j(field::rest_volume), k_j = j(field::conductivity), T_j = j(field::temperature);
    // The sum of both is taken first, so that it is the same seen from i and from j.
    const SymmetricOf<V> B = i(field::moment_inverse) + j(field::moment_inverse);
    const V k = harmonic_mean(k_i, k_j);
    const V moment = quadratic(B, g.d()) * g.per_r2, zero{};  // e^T B e
    const V share = where<V>(moment > zero, moment);
    const V G = where(g.within, (V_i * V_j) * (k * share) * -g.gradient);
    sum(field::heat_rate) += G * (T_j - T_i);
    sum(field::conductance) += G;
  }
};

}  // namespace tripoint
