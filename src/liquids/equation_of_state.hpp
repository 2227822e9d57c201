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
  /// Energy a p dV: the factor that makes p the force on an area, on the kernel's lattice (decision 6)
  double work = 1.0;
  double surface = 0.0;    ///< pressure of the topmost layer of a liquid [Pa], 0 = none
  double half_full = 0.5;  ///< density of that layer over the rest density, on the lattice
};

/// (9) as printed: p = k (rho - rho0) [Pa].
[[nodiscard]] inline double pressure_paper(const EquationOfState& e, double density) noexcept {
  const double p = e.stiffness * (density - e.rest_density);
  return e.clamp ? std::max(p, 0.0) : p;
}

/// Pressure of a particle below its rest density at a free surface (model 8.3) [Pa]: p_s (1 - |s - b|/(1 -
/// b)), s = rho/rho0, not below 0. In the topmost layer of a lattice s = b, and the pressure is p_s. In the
/// liquid, in a film of one layer and in drops it is 0.
[[nodiscard]] inline double surface_pressure(const EquationOfState& e, double density) noexcept {
  assert(e.half_full < 1.0);
  return e.surface *
         std::max(0.0, 1.0 - std::abs(density / e.rest_density - e.half_full) / (1.0 - e.half_full));
}

/// Integral of surface_pressure() over s from here to the rest density [Pa].
[[nodiscard]] inline double surface_pressure_above(const EquationOfState& e, double density) noexcept {
  const double s = density / e.rest_density, width = 1.0 - e.half_full;
  // Of the two slopes' feet
  const double above = s > e.half_full ? 1.0 - s : std::max(0.0, s - e.half_full + width);
  const double triangle = 0.5 * above * above / width;
  return e.surface * (s > e.half_full ? triangle : width - triangle);
}

/// (9) scaled so that all liquids are equally hard to compress (model 8.3): p = k (rho - rho0) rho_ref/rho0
/// [Pa]. Clamped, it is that of a free surface where this is negative.
[[nodiscard]] inline double pressure_corrected(const EquationOfState& e, double density) noexcept {
  const double p = e.stiffness * (density - e.rest_density) * (e.reference_density / e.rest_density);
  if (!e.clamp || e.surface == 0.0) return e.clamp ? std::max(p, 0.0) : p;
  return p < 0.0 ? surface_pressure(e, density) : p;
}

/// Energy of compression U of one particle [J], with dU/d(delta) = work p V^2, V = 1/delta, delta = rho/m.
/// U = work k rho_ref/rho0 (m ln(rho/rho0) + rho0 (V - V0)). Its gradient is the force of model 8.3. At a
/// free surface V is V0. U is then the work of the surface pressure since the rest density: -work V0 integral
/// from s to 1 of p, s = rho/rho0.
/// @param mass [kg]   @param density rho = m delta [kg/m3]
[[nodiscard]] inline double compression_energy(const EquationOfState& e, double mass,
                                               double density) noexcept {
  assert(mass > 0.0 && density > 0.0);
  const double s = density / e.rest_density;
  if (e.clamp && density <= e.rest_density) {
    return e.surface == 0.0 ? 0.0 : -e.work * mass / e.rest_density * surface_pressure_above(e, density);
  }
  return e.work * e.stiffness * e.reference_density / e.rest_density * mass * (std::log(s) + 1.0 / s - 1.0);
}

/// Speed of sound [m/s] that bounds the step: max sqrt(k rho_ref/rho0) (model 8.3).
[[nodiscard]] inline double sound_speed(const EquationOfState& e) noexcept {
  return std::sqrt(e.stiffness * e.reference_density / e.rest_density);
}

}  // namespace tripoint
