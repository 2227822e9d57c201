// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/heat/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint {

/// Conduction (21) as printed: dT_i/dt = c_i sum_j (m_j/rho_j) (T_j - T_i) lap W_visc(r_ij) [K/s].
/// Its faults: on the lattice its rate has a floor, 0.93 of the exact one at h/dx = 2.12 whatever the number of particles. Where
/// density or conductivity jump, it keeps sum V T, not energy.
struct HeatFlowPaper {
  static constexpr std::string_view name = "HeatFlowPaper";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::temperature, field::diffusivity>;
  using adds = Keys<field::temperature_rate, field::exchange>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 3> i, std::span<const V, 3> j, std::span<V, 2> sum) {
    const V V_j = j[0], T_j = j[1], T_i = i[1], c_i = i[2];
    const V a = where(g.within, c_i * V_j * g.kernels.viscosity.laplacian_inside(g.r));
    sum[0] += a * (T_j - T_i);
    sum[1] += a;
  }
};

/// Second moment M_i = 1/2 sum_j V_j K r r^T, K = -2 W'(r)/r (model 8.6): the unit matrix in a bulk that is fine enough. It is
/// summed to the columns of its inverse, and inverted there.
struct HeatMoment {
  static constexpr std::string_view name = "HeatMoment";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::rest_volume>;
  using adds = Keys<field::moment_inverse_xx, field::moment_inverse_yy, field::moment_inverse_zz, field::moment_inverse_yz,
                    field::moment_inverse_xz, field::moment_inverse_xy>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 1>, std::span<const V, 1> j, std::span<V, 6> sum) {
    const V V_j = j[0];
    add_outer(where(g.within, V_j * -g.gradient), g, sum);  // 1/2 V_j K
  }
};

/// Conduction between i and j, (21) corrected (model 8.6) [W]: equal and opposite for each pair, so that sum H is kept. It is
/// G_ij (T_j - T_i), G_ij = V_i V_j [2 k_i k_j/(k_i + k_j)] [1/2 e^T (pinv M_i + pinv M_j) e] K.
struct HeatFlowCorrected {
  static constexpr std::string_view name = "HeatFlowCorrected";
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::rest_volume, field::conductivity, field::temperature, field::moment_inverse_xx, field::moment_inverse_yy,
           field::moment_inverse_zz, field::moment_inverse_yz, field::moment_inverse_xz, field::moment_inverse_xy>;
  using adds = Keys<field::heat_rate, field::conductance>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 9> i, std::span<const V, 9> j, std::span<V, 2> sum) {
    const V V_i = i[0], k_i = i[1], T_i = i[2];
    const V V_j = j[0], k_j = j[1], T_j = j[2];
    // A = pinv M_i + pinv M_j: the sum of both is taken first, so that it is the same seen from i and from j.
    const V A_xx = i[3] + j[3], A_yy = i[4] + j[4], A_zz = i[5] + j[5];
    const V A_yz = i[6] + j[6], A_xz = i[7] + j[7], A_xy = i[8] + j[8];
    const V k = harmonic_mean(k_i, k_j);
    const V rAr = A_xx * (g.dx * g.dx) + A_yy * (g.dy * g.dy) + A_zz * (g.dz * g.dz) +
                  2.0 * (A_yz * (g.dy * g.dz) + A_xz * (g.dx * g.dz) + A_xy * (g.dx * g.dy));
    const V moment = rAr * g.per_r2;  // e^T A e
    const V G = where(g.within, (V_i * V_j) * (k * moment) * -g.gradient);
    sum[0] += G * (T_j - T_i);
    sum[1] += G;
  }
};

}  // namespace tripoint
