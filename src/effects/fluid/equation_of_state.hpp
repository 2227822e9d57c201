// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cassert>
#include <cmath>

/// Pressure from density (9), and the energy whose gradient the corrected pressure force is (model 8.3).
namespace tripoint {

/// One liquid's or solid's part in the scene's equation of state.
struct EquationOfState {
  double stiffness;          ///< k of the scene [m2/s2]
  double rest_density;       ///< rho0 of the particle [kg/m3]
  double reference_density;  ///< rho_ref, the largest rest density of the scene's liquids [kg/m3]
  bool clamp;                ///< no negative pressure: free surfaces and contacts do not pull
  double work = 1.0;         ///< energy a p dV: what makes p the force on an area, on the kernel's lattice (decision 6)
};

/// (9) as printed: p = k (rho - rho0) [Pa].
[[nodiscard]] inline double pressure_paper(const EquationOfState& e, double density) noexcept {
  const double p = e.stiffness * (density - e.rest_density);
  return e.clamp ? std::max(p, 0.0) : p;
}

/// (9) scaled so that all liquids are equally hard to compress (model 8.3): p = k (rho - rho0) rho_ref/rho0 [Pa].
[[nodiscard]] inline double pressure_corrected(const EquationOfState& e, double density) noexcept {
  const double p = e.stiffness * (density - e.rest_density) * (e.reference_density / e.rest_density);
  return e.clamp ? std::max(p, 0.0) : p;
}

/// Energy of compression of one particle [J], U with dU/d(delta) = work p V^2, V = 1/delta, delta = rho/m:
/// U = work k rho_ref/rho0 (m ln(rho/rho0) + rho0 (V - V0)); its gradient is the force of model 8.3.
/// @param mass [kg]   @param density rho = m delta [kg/m3]
[[nodiscard]] inline double compression_energy(const EquationOfState& e, double mass, double density) noexcept {
  assert(mass > 0.0 && density > 0.0);
  if (e.clamp && density <= e.rest_density) return 0.0;
  const double s = density / e.rest_density;
  return e.work * e.stiffness * e.reference_density / e.rest_density * mass * (std::log(s) + 1.0 / s - 1.0);
}

/// Speed of sound [m/s] that bounds the step: max sqrt(k rho_ref/rho0) (model 8.3).
[[nodiscard]] inline double sound_speed(const EquationOfState& e) noexcept {
  return std::sqrt(e.stiffness * e.reference_density / e.rest_density);
}

}  // namespace tripoint
