// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cassert>

namespace tripoint {

/// Enthalpy of a particle, H = m c_p T [J] (model 8.9 without latent heat).
/// @param mass [kg]  @param heat_capacity [J/kg/K]  @param temperature [K]
[[nodiscard]] inline double enthalpy_of(double mass, double heat_capacity, double temperature) noexcept {
  assert(mass > 0.0 && heat_capacity > 0.0);
  return mass * heat_capacity * temperature;
}

/// Temperature from enthalpy [K], the inverse of enthalpy_of.
[[nodiscard]] inline double temperature_of(double mass, double heat_capacity, double enthalpy) noexcept {
  assert(mass > 0.0 && heat_capacity > 0.0);
  return enthalpy / (mass * heat_capacity);
}

}  // namespace tripoint
