// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>

#include "liquids/listed_pairs.hpp"
#include "sph/kernels.hpp"
#include "sph/lattice.hpp"
#include "state/state.hpp"

namespace tripoint::liquid {

/// Rest density of each row that is liquid, 0 of all others [kg/m3].
using LiquidDensities = std::span<const double>;

/// Liquids of two densities at rest (model 8.3). The mean of two pressures in a pair is that of the place
/// between its particles where the pressure is linear. Across an interface the pressure has a kink, and the
/// mean is off by the weight of half a layer. Every second layer would then have too high a pressure. Pairs
/// of unlike liquids therefore have the energy a (g.d) K(r), d = r_j - r_i. a = s/2 (rho0_i - rho0_j) V0^2/M,
/// K = (c + c2 r^2/dx^2) W. With this K both layers beside a flat interface of the lattice are at rest under
/// the exact pressures (interface_kernel()).
class InterfaceWeight {
 public:
  /// @param share s, 1 for exact pressures
  InterfaceWeight(const Scene&, double share);
  [[nodiscard]] bool acts() const noexcept { return factor_ != 0.0; }
  /// The force of that energy, after the pass of rates.
  void add_forces(State&, const PairKernels&, LiquidDensities, const Rows&);
  /// Energy of a pair of unlike liquids [J]. @param d r_j - r_i [m]
  [[nodiscard]] double energy(const PairKernels&, const Vec3& d, double rest_i, double rest_j) const;
  /// Half of the energies of the pairs of a row [J].
  [[nodiscard]] double energy(const State&, const PairKernels&, LiquidDensities, std::size_t row) const;
  /// Rows or groups have changed: look again which liquids meet.
  void clear() { pairs_.clear(); }

 private:
  void find(const State&, LiquidDensities);

  double factor_ = 0.0;  ///< s/2 V0^2/M [m6]
  Vec3 gravity_;         ///< across directions that are not periodic [m/s2]
  InterfaceKernel kernel_;
  ListedPairs<> pairs_;  ///< of liquids with another liquid near
};

}  // namespace tripoint::liquid
