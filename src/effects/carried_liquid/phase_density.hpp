// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "liquids/interface_weight.hpp"
#include "sph/kernels.hpp"
#include "state/state.hpp"

/// Density of what becomes liquid, and the energy of compression that comes and goes with it.
namespace tripoint::carried_liquid {

/// A density at the start of a step, after its rate, and after what else moves it [kg/m3].
struct DensityStep {
  double before, moved, next;
};

/// p = modulus (rho/rho0 - 1), and what depends on it.
struct CarriedState {
  double modulus = 0.0;  ///< k rho_ref, of all liquids [Pa]
  bool clamp = false;
  [[nodiscard]] double pressure(double rho, double rest) const;
  /// m e(rho), de = p/rho^2 drho, from the rest density [J].
  [[nodiscard]] double energy(double mass, double rho, double rest) const;
  /// Energy that `moved` to `next` adds [J]. The forces of the mean pressure of a step work on what its rate
  /// moves, so half of what is added there is theirs.
  [[nodiscard]] double added(double mass, double rest, const DensityStep&) const;
  /// Of a liquid whose neighbourhood solids fill by `share` [J].
  [[nodiscard]] double wall_energy(double mass, double rest, double share) const;
};

inline constexpr double inside_wall = 0.5;

/// Rows of what changed, and of their neighbours.
[[nodiscard]] std::vector<std::size_t> touched_rows(const State&, const std::vector<std::uint32_t>& ids);

/// Energy of compression of a particle, without that of solids that push it out [J].
class CompressionEnergy {
 public:
  CompressionEnergy(const State&, const CarriedState&);
  [[nodiscard]] double operator()(std::size_t row) const;

 private:
  CarriedState equation_;
  std::span<const double> impedance_, mass_, density_, rest_;
};

/// Rest density of each row that is liquid, 0 of all others [kg/m3].
[[nodiscard]] std::vector<double> densities_of_liquids(const State&);

/// Energy of compression of these rows, and of their pairs with all others [J]. @param back time since the
/// places meant [s]
[[nodiscard]] double energy_of(const State&, const CarriedState&, const liquid::InterfaceWeight&,
                               const PairKernels&, const std::vector<std::size_t>& rows, double back);

/// What flows in takes the pressure of the liquid around it; alone it is at rest density.
/// @param ids of new liquids   @pre their materials are set, and those of all others too
void take_pressure_around(State&, const CarriedState&, const PairKernels&,
                          const std::vector<std::uint32_t>& ids);

}  // namespace tripoint::carried_liquid
