// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "liquids/listed_pairs.hpp"
#include "sph/kernels.hpp"
#include "sph/lattice.hpp"
#include "state/state.hpp"

namespace tripoint::interfaces {

/// Liquids of two densities at rest (model 8.3). The mean of two pressures in a pair is that of the place
/// between its particles where the pressure is linear. Across an interface the pressure has a kink, and the
/// mean is off by the weight of half a layer. Every second layer would then have too high a pressure. Pairs
/// of unlike liquids therefore have the energy a (g.d) K(r), d = r_j - r_i. a = s/2 (rho0_i - rho0_j) V0^2/M,
/// s = scene.interface_weight, K = (c + c2 r^2/dx^2) W. With this K both layers beside a flat interface of
/// the lattice are at rest under the exact pressures (interface_kernel()).
class InterfaceWeight {
 public:
  explicit InterfaceWeight(const Scene&);
  [[nodiscard]] bool acts() const noexcept { return factor_ != 0.0; }
  /// The force of that energy, after the pass of rates.
  void add_forces(State&, const PairKernels&, const Rows&);
  /// Half of the energies of the pairs of a row [J].
  [[nodiscard]] double energy(const State&, const PairKernels&, std::size_t row) const;
  /// Rows or groups have changed: look again which liquids meet.
  void clear() { pairs_.clear(); }

 private:
  void find(const State&);

  double factor_ = 0.0;  ///< s/2 V0^2/M [m6]
  Vec3 gravity_;         ///< across directions that are not periodic [m/s2]
  InterfaceKernel kernel_;
  liquid::ListedPairs<> pairs_;  ///< of liquids with another liquid near
};

}  // namespace tripoint::interfaces
