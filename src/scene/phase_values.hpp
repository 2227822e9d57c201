// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"

/// Material values that differ between the phases.
namespace tripoint {

[[nodiscard]] inline bool has_two_phases(const Material& m) { return m.solid_conductivity || m.solid_heat_capacity; }

/// Of a phase [W/m/K]. @pre the material conducts
[[nodiscard]] inline double conductivity_of(const Material& m, Phase phase) {
  return phase == Phase::liquid ? *m.conductivity : m.solid_conductivity.value_or(*m.conductivity);
}
/// Of a phase [J/kg/K]. @pre the material holds heat
[[nodiscard]] inline double heat_capacity_of(const Material& m, Phase phase) {
  return phase == Phase::liquid ? *m.heat_capacity : m.solid_heat_capacity.value_or(*m.heat_capacity);
}
/// Heat of fusion at a temperature [J/kg]: that at t_melt, and what the liquid takes up more than the solid on the way (Kirchhoff's law).
[[nodiscard]] inline double latent_heat_at(const Material& m, double temperature) {
  const double latent = m.latent_heat.value_or(0.0);
  return m.solid_heat_capacity ? latent + (*m.heat_capacity - *m.solid_heat_capacity) * (temperature - *m.t_melt) : latent;
}

}  // namespace tripoint
