// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <type_traits>

#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint::field {

/// sum_j G_ij, or sum_j G_ij e e^T, while the bound of the step is formed: no column of a scene
inline constexpr SymmetricField viscous_spread{"viscous_spread", "kg/s"};

}  // namespace tripoint::field

/// Pair terms of viscosity, printed and corrected. d = r_j - r_i, so that grad_i W = -(W'/r) d.
namespace tripoint {

/// Viscosity of a pair [Pa s] (model 8.5). Between liquids it is the harmonic mean. At a solid it is the
/// liquid's own, 0 where that slips freely. Between solids it is the scene's contact viscosity, which
/// `viscosity` of a solid holds.
template <class V>
[[nodiscard]] inline V pair_viscosity(const auto& i, const auto& j) noexcept {
  const V mu_i = i(field::viscosity), solid_i = i(field::solid), stick_i = i(field::stick);
  const V mu_j = j(field::viscosity), solid_j = j(field::solid), stick_j = j(field::stick);
  const V liquids = harmonic_mean(mu_i, mu_j);
  if (!any(solid_i + solid_j != 0.0)) return liquids;
  const MaskOf<V> is_solid_i = solid_i != 0.0, is_solid_j = solid_j != 0.0;
  const V with_j = is_solid_j ? 0.5 * (mu_i + mu_j) : mu_j * stick_i,
          without_j = is_solid_j ? mu_i * stick_j : liquids;
  return is_solid_i ? with_j : without_j;
}

using ViscousKeys =
    Keys<field::volume, field::viscosity, field::solid, field::stick, field::group, field::viscous_velocity>;

/// Viscous force (8) as printed [N]: F_i = sum_j V_i V_j (mu_i + mu_j)/2 (v_j - v_i) lap W_visc.
/// Its faults: walls slip, the lattice factor is 0.93, and a rigidly turning liquid ball is braked.
struct ViscosityPaper {
  static constexpr std::string_view name = "ViscosityPaper";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = Keys<field::viscous_force>;
  /// G_ij [kg/s]
  template <class V>
  static V coefficient(const PairGeometry<V>& g, const auto& i, const auto& j) {
    const V V_i = i(field::volume), mu_i = i(field::viscosity), group_i = i(field::group);
    const V V_j = j(field::volume), mu_j = j(field::viscosity), group_j = j(field::group);
    const V share = (0.5 * V_i) * (V_j * (mu_i + mu_j));
    return where(g.apart & acts(group_i, group_j), share * g.kernels.viscosity.laplacian_inside(g.r));
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    sum(field::viscous_force) +=
        coefficient<V>(g, i, j) * (j(field::viscous_velocity) - i(field::viscous_velocity));
  }
};

/// `laplacian` (model 8.5) [N]: F_i = sum_j (V_i^2 + V_j^2) mu_ij (-W'/r)(v_j - v_i) over the kernel's
/// lattice moment. For wall-bounded shear only: it does not keep angular momentum.
struct ViscosityLaplacian {
  static constexpr std::string_view name = "ViscosityLaplacian";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = Keys<field::viscous_force>;
  /// G_ij [kg/s]
  template <class V>
  static V coefficient(const PairGeometry<V>& g, const auto& i, const auto& j) {
    const V V_i = i(field::volume), group_i = i(field::group);
    const V V_j = j(field::volume), group_j = j(field::group);
    const V mu = pair_viscosity<V>(i, j);
    const V share = g.kernels.per_gradient_moment * (V_i * V_i + V_j * V_j) * mu;
    return where(g.apart & acts(group_i, group_j), share * -g.gradient);
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    sum(field::viscous_force) +=
        coefficient<V>(g, i, j) * (j(field::viscous_velocity) - i(field::viscous_velocity));
  }
};

/// `central` (model 8.5) [N]: F_ij = 10 mu_ij V_i V_j (-W'/r) ((v_j - v_i).r_ij) r_ij/r^2 over the same
/// moment. It acts along the line of centres, so angular momentum is kept and a rigid rotation feels nothing.
/// `weighted`: for isotropic shear.
template <bool weighted>
struct ViscosityCentralOf {
  static constexpr std::string_view name = weighted ? "ViscosityCentralWeighted" : "ViscosityCentral";
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = Keys<field::viscous_force>;
  /// G_ij [kg/s], of the velocity along the line of centres
  template <class V>
  static V coefficient(const PairGeometry<V>& g, const auto& i, const auto& j) {
    const V V_i = i(field::volume), group_i = i(field::group);
    const V V_j = j(field::volume), group_j = j(field::group);
    const V mu = pair_viscosity<V>(i, j);
    const V share = (g.kernels.central * g.kernels.per_gradient_moment * V_i) * (V_j * mu);
    return where(g.apart & acts(group_i, group_j), share * shear_weighted<weighted>(g));
  }
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V G = coefficient<V>(g, i, j);
    const VectorOf<V> dv = j(field::viscous_velocity) - i(field::viscous_velocity);
    const V along = G * (dot(dv, g.d()) * g.per_r2);
    sum(field::viscous_force) += along * g.d();
  }
};

using ViscosityCentral = ViscosityCentralOf<false>;
using ViscosityCentralWeighted = ViscosityCentralOf<true>;

/// sum_j G_ij of a viscosity [kg/s], and for `central` sum_j G_ij e e^T, for the bound of the step. The sums
/// stand in scratch memory of update_viscous_bound().
template <class Viscosity>
struct ViscousSpread {
  static constexpr std::string_view word = "ViscousSpread of ",
                                    name = JoinedName<word, Viscosity::name>::value;
  static constexpr bool central =
      std::is_same_v<Viscosity, ViscosityCentral> || std::is_same_v<Viscosity, ViscosityCentralWeighted>;
  static constexpr bool zero_beyond = true;
  using reads = ViscousKeys;
  using adds = Keys<field::viscous_spread>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V G = Viscosity::template coefficient<V>(g, i, j);
    if constexpr (central) {
      sum(field::viscous_spread) += (G * g.per_r2) * square(g.d());
    } else {
      sum(field::viscous_spread).xx += G;
    }
  }
};

}  // namespace tripoint
