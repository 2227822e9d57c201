// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <type_traits>

#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

/// Pair terms of liquids, and of everything that touches: pressure and viscosity, printed and corrected.
/// d = r_j - r_i, so that grad_i W = -(W'/r) d.
namespace tripoint {

/// Pressure force (7) corrected (model 8.3) [N]: F_i = -sum_j (V_i^2 p_i + V_j^2 p_j) grad_i W, the gradient of
/// compression_energy(). `pressure_share` is V^2 p over the kernel's lattice moment, so that p is the force on an area also on
/// the lattice (decision 6). The core energy 1/2 kappa (b - r)^2, b = scene.core_reach dx, is added. It keeps pairs apart where
/// the clamp leaves no repulsion.
struct PressureCorrected {
  static constexpr std::string_view name = "PressureCorrected";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::pressure_share, field::group>;
  using adds = Keys<field::force_x, field::force_y, field::force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 2> i, std::span<const V, 2> j, std::span<V, 3> sum) {
    const V share_i = i[0], share_j = j[0], group_i = i[1], group_j = j[1];
    const V pressure = (share_i + share_j) * g.gradient;
    const V f = where(g.apart & acts(group_i, group_j), pressure - g.kernels.core.force_over_r(g.r, g.per_r2));
    sum[0] += f * g.dx;
    sum[1] += f * g.dy;
    sum[2] += f * g.dz;
  }
};

/// Pressure force (7) as printed [N]: F_i = -sum_j V_i V_j (p_i + p_j)/2 grad_i W_spiky, V = m/rho of (4).
/// Its faults: it tends to half of grad p, and a clamped mixture of two kernels does not keep energy in contacts.
struct PressurePaper {
  static constexpr std::string_view name = "PressurePaper";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::volume, field::pressure, field::group>;
  using adds = Keys<field::force_x, field::force_y, field::force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 3> i, std::span<const V, 3> j, std::span<V, 3> sum) {
    const V V_i = i[0], p_i = i[1], group_i = i[2];
    const V V_j = j[0], p_j = j[1], group_j = j[2];
    const V share = (0.5 * V_i) * (V_j * (p_i + p_j));
    const V f = where(g.apart & acts(group_i, group_j), share * (g.kernels.spiky.derivative_inside(g.r) * (g.r * g.per_r2)));
    sum[0] += f * g.dx;
    sum[1] += f * g.dy;
    sum[2] += f * g.dz;
  }
};

/// Viscosity of a pair [Pa s] (model 8.5). Between liquids it is the harmonic mean. At a solid it is the liquid's own, 0 where
/// that slips freely. Between solids it is the scene's contact viscosity, which `viscosity` of a solid holds.
template <class V>
[[nodiscard]] inline V pair_viscosity(V mu_i, V solid_i, V stick_i, V mu_j, V solid_j, V stick_j) noexcept {
  const V liquids = harmonic_mean(mu_i, mu_j);
  if (!any(solid_i + solid_j != 0.0)) return liquids;
  const MaskOf<V> is_solid_i = solid_i != 0.0, is_solid_j = solid_j != 0.0;
  const V with_j = is_solid_j ? 0.5 * (mu_i + mu_j) : mu_j * stick_i, without_j = is_solid_j ? mu_i * stick_j : liquids;
  return is_solid_i ? with_j : without_j;
}

using ViscousKeys = Keys<field::volume, field::viscosity, field::solid, field::stick, field::group, field::viscous_velocity_x,
                         field::viscous_velocity_y, field::viscous_velocity_z>;
using ViscousForce = Keys<field::viscous_force_x, field::viscous_force_y, field::viscous_force_z>;

/// Adds G_ij (v_j - v_i) [N]. @param G [kg/s]
template <class V>
inline void add_viscous_force(V G, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 3> sum) noexcept {
  const V vx_i = i[5], vy_i = i[6], vz_i = i[7];
  const V vx_j = j[5], vy_j = j[6], vz_j = j[7];
  sum[0] += G * (vx_j - vx_i);
  sum[1] += G * (vy_j - vy_i);
  sum[2] += G * (vz_j - vz_i);
}

/// Viscous force (8) as printed [N]: F_i = sum_j V_i V_j (mu_i + mu_j)/2 (v_j - v_i) lap W_visc.
/// Its faults: walls slip, the lattice factor is 0.93, and a rigidly turning liquid ball is braked.
struct ViscosityPaper {
  static constexpr std::string_view name = "ViscosityPaper";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = ViscousForce;
  /// G_ij [kg/s]
  template <class V>
  static V coefficient(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j) {
    const V V_i = i[0], mu_i = i[1], group_i = i[4];
    const V V_j = j[0], mu_j = j[1], group_j = j[4];
    const V share = (0.5 * V_i) * (V_j * (mu_i + mu_j));
    return where(g.apart & acts(group_i, group_j), share * g.kernels.viscosity.laplacian_inside(g.r));
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 3> sum) {
    add_viscous_force(coefficient<V>(g, i, j), i, j, sum);
  }
};

/// `laplacian` (model 8.5) [N]: F_i = sum_j (V_i^2 + V_j^2) mu_ij (-W'/r)(v_j - v_i) over the kernel's lattice moment.
/// For wall-bounded shear only: it does not keep angular momentum.
struct ViscosityLaplacian {
  static constexpr std::string_view name = "ViscosityLaplacian";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = ViscousForce;
  /// G_ij [kg/s]
  template <class V>
  static V coefficient(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j) {
    const V V_i = i[0], mu_i = i[1], solid_i = i[2], stick_i = i[3], group_i = i[4];
    const V V_j = j[0], mu_j = j[1], solid_j = j[2], stick_j = j[3], group_j = j[4];
    const V mu = pair_viscosity<V>(mu_i, solid_i, stick_i, mu_j, solid_j, stick_j);
    const V share = g.kernels.per_gradient_moment * (V_i * V_i + V_j * V_j) * mu;
    return where(g.apart & acts(group_i, group_j), share * -g.gradient);
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 3> sum) {
    add_viscous_force(coefficient<V>(g, i, j), i, j, sum);
  }
};

/// `central` (model 8.5) [N]: F_ij = 10 mu_ij V_i V_j (-W'/r) ((v_j - v_i).r_ij) r_ij/r^2 over the same moment. It acts along the
/// line of centres, so angular momentum is kept and a rigid rotation feels nothing. `weighted`: for isotropic shear.
template <bool weighted>
struct ViscosityCentralOf {
  static constexpr std::string_view name = weighted ? "ViscosityCentralWeighted" : "ViscosityCentral";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = ViscousForce;
  /// G_ij [kg/s], of the velocity along the line of centres
  template <class V>
  static V coefficient(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j) {
    const V V_i = i[0], mu_i = i[1], solid_i = i[2], stick_i = i[3], group_i = i[4];
    const V V_j = j[0], mu_j = j[1], solid_j = j[2], stick_j = j[3], group_j = j[4];
    const V mu = pair_viscosity<V>(mu_i, solid_i, stick_i, mu_j, solid_j, stick_j);
    const V share = (10.0 * g.kernels.per_gradient_moment * V_i) * (V_j * mu);
    return where(g.apart & acts(group_i, group_j), share * shear_weighted<weighted>(g));
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 3> sum) {
    const V G = coefficient<V>(g, i, j);
    const V vx_i = i[5], vy_i = i[6], vz_i = i[7];
    const V vx_j = j[5], vy_j = j[6], vz_j = j[7];
    const V dvx = vx_j - vx_i, dvy = vy_j - vy_i, dvz = vz_j - vz_i;
    const V along = G * ((dvx * g.dx + dvy * g.dy + dvz * g.dz) * g.per_r2);
    sum[0] += along * g.dx;
    sum[1] += along * g.dy;
    sum[2] += along * g.dz;
  }
};

using ViscosityCentral = ViscosityCentralOf<false>;
using ViscosityCentralWeighted = ViscosityCentralOf<true>;

/// sum_j G_ij of a viscosity [kg/s], and for `central` sum_j G_ij e e^T (xx, yy, zz, yz, xz, xy), for the bound of the step. It
/// has no columns of its own. The six columns of forces hold these sums, not newtons, in the order of `adds`, until the pass that
/// fills them anew. Only update_viscous_bound() reads them.
template <class Viscosity>
struct ViscousSpread {
  static constexpr std::string_view word = "ViscousSpread of ", name = JoinedName<word, Viscosity::name>::value;
  static constexpr bool central =
      std::is_same_v<Viscosity, ViscosityCentral> || std::is_same_v<Viscosity, ViscosityCentralWeighted>;
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = Keys<field::force_x, field::force_y, field::force_z, field::viscous_force_x, field::viscous_force_y,
                    field::viscous_force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 6> sum) {
    const V G = Viscosity::template coefficient<V>(g, i, j);
    if constexpr (central) {
      add_outer(G * g.per_r2, g, sum);
    } else {
      sum[0] += G;
    }
  }
};

}  // namespace tripoint
