// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/fields.hpp"
#include "pairs/pass.hpp"

namespace tripoint {

/// Density (4): rho_i = sum_j m_j W_poly6(r_ij) [kg/m3]; the particle itself is added before the pass.
struct DensityPaper {
  static constexpr std::string_view name = "DensityPaper";
  using reads = Keys<field::mass>;
  using adds = Keys<field::density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto& j, auto& sum) {
    const V m_j = j(field::mass);
    sum(field::density) += m_j * g.kernels.poly6.value_of_square_inside(g.r2);
  }
};

/// Number density (model 8.2) [Solenthaler & Pajarola 2008]: delta_i = sum_j W(r_ij) [1/m3]. The particle
/// itself and its excluded pairs are added before the pass. The division by the kernel's lattice sum follows.
struct NumberDensity {
  static constexpr std::string_view name = "NumberDensity";
  static constexpr bool zero_beyond = true;
  using reads = Keys<>;
  using adds = Keys<field::number_density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto&, auto& sum) {
    sum(field::number_density) += where(g.apart, g.kernels.wendland.value_inside(g.r));
  }
};

/// The same over solids alone.
struct SolidNumberDensity {
  static constexpr std::string_view name = "SolidNumberDensity";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::group>;
  using adds = Keys<field::number_density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto& j, auto& sum) {
    const V group_j = j(field::group);
    sum(field::number_density) +=
        where(g.apart & (group_j != liquid_group), g.kernels.wendland.value_inside(g.r));
  }
};

}  // namespace tripoint
