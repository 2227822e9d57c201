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

/// Second moment M_i = 1/2 sum_j V_j K r r^T, K = -2 W'(r)/r (model 8.6): the unit matrix in a bulk that is
/// fine enough. It is summed to the columns of its inverse, and inverted there.
struct HeatMoment {
  static constexpr std::string_view name = "HeatMoment";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::rest_volume>;
  using adds = Keys<field::moment_inverse>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto& j, auto& sum) {
    const V V_j = j(field::rest_volume);
    sum(field::moment_inverse) += where(g.within, V_j * -g.gradient) * square(g.d());  // 1/2 V_j K d d^T
  }
};

/// Conduction between i and j, (21) corrected (model 8.6) [W]: equal and opposite for each pair, so that sum
/// H is kept. It is G_ij (T_j - T_i), G_ij = V_i V_j [2 k_i k_j/(k_i + k_j)] [1/2 e^T (pinv M_i + pinv M_j)
/// e] K.
struct HeatFlowCorrected {
  static constexpr std::string_view name = "HeatFlowCorrected";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::rest_volume, field::conductivity, field::temperature, field::moment_inverse>;
  using adds = Keys<field::heat_rate, field::conductance>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V V_i = i(field::rest_volume), k_i = i(field::conductivity), T_i = i(field::temperature);
    const V V_j = j(field::rest_volume), k_j = j(field::conductivity), T_j = j(field::temperature);
    // A = pinv M_i + pinv M_j: the sum of both is taken first, so that it is the same seen from i and from j.
    const SymmetricOf<V> A = i(field::moment_inverse) + j(field::moment_inverse);
    const V k = harmonic_mean(k_i, k_j);
    const V moment = quadratic(A, g.d()) * g.per_r2;  // e^T A e
    const V G = where(g.within, (V_i * V_j) * (k * moment) * -g.gradient);
    sum(field::heat_rate) += G * (T_j - T_i);
    sum(field::conductance) += G;
  }
};

}  // namespace tripoint
