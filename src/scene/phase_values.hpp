// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"
#include "scene/shared_terms.hpp"

/// Material values that differ between the phases.
namespace tripoint {

[[nodiscard]] inline bool has_two_phases(const Material& m) {
  return m.solid_conductivity || m.solid_heat_capacity;
}

/// Whether a material has the middle stage of Fig. 5, printed alone: t_solid < t_melt.
[[nodiscard]] inline bool has_printed_stage(const Scene& scene, const Material& m) {
  return scene.mode_of(term::phase) == Mode::paper && m.t_melt && m.t_solid.value_or(*m.t_melt) < *m.t_melt;
}
/// Whether a rigid solid of this material is elastic in that stage: where it softens, and has a modulus that
/// can fall. Else it stays rigid up to t_melt.
[[nodiscard]] inline bool turns_elastic(const Scene& scene, const Material& m) {
  return m.softens && m.solid == SolidKind::rigid && m.young_modulus && m.poisson_ratio &&
         has_printed_stage(scene, m);
}

/// Conductivity of a phase [W/m/K]. @pre the material conducts
[[nodiscard]] inline double conductivity_of(const Material& m, Phase phase) {
  return phase == Phase::liquid ? *m.conductivity : m.solid_conductivity.value_or(*m.conductivity);
}
/// Heat capacity of a phase [J/kg/K]. @pre the material holds heat
[[nodiscard]] inline double heat_capacity_of(const Material& m, Phase phase) {
  return phase == Phase::liquid ? *m.heat_capacity : m.solid_heat_capacity.value_or(*m.heat_capacity);
}
/// Heat of fusion at a temperature [J/kg]: that at t_melt, plus the difference of heat between liquid and
/// solid on the way (Kirchhoff's law).
[[nodiscard]] inline double latent_heat_at(const Material& m, double temperature) {
  const double latent = m.latent_heat.value_or(0.0);
  return m.solid_heat_capacity
             ? latent + (*m.heat_capacity - *m.solid_heat_capacity) * (temperature - *m.t_melt)
             : latent;
}

}  // namespace tripoint
