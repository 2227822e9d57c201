// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

#include "scene/phase_values.hpp"
#include "scene/shared_terms.hpp"
#include "state/state.hpp"

/// Melting and freezing of one particle, the state (H, f) of model 8.9: H = m (c_p T + L f), 0 <= f <= 1.
namespace tripoint {

/// Constants of a material's phase change. It melts at one temperature and freezes at another, not higher: a
/// true hysteresis.
struct Fusion {
  double melts = std::numeric_limits<double>::infinity();        ///< t_melt [K]
  double solidifies = -std::numeric_limits<double>::infinity();  ///< t_solid [K]
  /// L/c_p: the heat of fusion as a temperature of the solid [K]
  double heat = 0.0;
  /// Printed (Fig. 5): f follows T between the two, solid below t_melt and the softer the nearer to it
  bool soft_band = false;
  double jump = 0.0;  ///< heat capacity of the liquid over that of the solid, minus 1
};

/// Heat capacity of the solid [J/kg/K], by which the heat of a particle of any phase is counted. @pre the
/// material holds heat
[[nodiscard]] inline double solid_capacity(const Material& m) {
  return m.solid_heat_capacity.value_or(*m.heat_capacity);
}

/// Fusion of a material: none where it does not melt. `paper` (Fig. 5) knows no latent heat and no
/// hysteresis: T alone decides, at t_melt. An elastic solid is soft between t_solid and t_melt, and so is a
/// rigid one that softens (`turns_elastic`); else it is rigid up to t_melt.
[[nodiscard]] inline Fusion fusion_of(const Scene& scene, const Material& m) {
  if (!m.t_melt || !m.heat_capacity) return {};
  if (scene.mode_of(term::phase) == Mode::paper) {
    const bool band =
        has_printed_stage(scene, m) && (m.solid == SolidKind::elastic || turns_elastic(scene, m));
    return {*m.t_melt, band ? *m.t_solid : *m.t_melt, 0.0, band};
  }
  return {*m.t_melt, m.t_solid.value_or(*m.t_melt), m.latent_heat.value_or(0.0) / solid_capacity(m), false,
          *m.heat_capacity / solid_capacity(m) - 1.0};
}
/// By row in Scene::materials.
[[nodiscard]] inline std::vector<Fusion> fusions_of(const Scene& scene) {
  std::vector<Fusion> list;
  for (const Material& m : scene.materials) list.push_back(fusion_of(scene, m));
  return list;
}

/// T [K] and f [1].
struct ThermalState {
  double temperature, liquid_fraction;
};

/// H/(m c) [K] above that of the same particle at temperature T and f = 0, by the heat capacity c of the
/// solid. It is the heat of fusion, plus the extra heat that the liquid holds. The heat of fusion is L at
/// t_melt; elsewhere it differs by the heat that the two phases take up on the way (Kirchhoff).
[[nodiscard]] inline double bound_heat(const Fusion& fusion, double T, double f) noexcept {
  if (fusion.jump == 0.0) return fusion.heat * f;
  return f * (fusion.heat + fusion.jump * (T - fusion.melts));
}

/// Temperature of a particle by its H/(m c) and liquid fraction, c that of the solid [K].
[[nodiscard]] inline double temperature_at(const Fusion& fusion, double content, double f) noexcept {
  if (fusion.jump == 0.0) return content - fusion.heat * f;
  return (content - f * (fusion.heat - fusion.jump * fusion.melts)) / (1.0 + fusion.jump * f);
}

/// `settled` where the two phases hold unlike amounts of heat.
[[nodiscard]] inline ThermalState settled_between_unlike(const Fusion& fusion, double trial,
                                                         double f) noexcept {
  const double content = trial + bound_heat(fusion, trial, f);
  double next = f;
  if (trial > fusion.melts && f < 1.0)
    next = fusion.heat > 0.0 ? std::min(1.0, (content - fusion.melts) / fusion.heat) : 1.0;
  if (trial < fusion.solidifies && f > 0.0) {
    const double released = fusion.heat - fusion.jump * (fusion.melts - fusion.solidifies);
    next = released > 0.0 ? std::max(0.0, (content - fusion.solidifies) / released) : 0.0;
  }
  return {next == f ? trial : temperature_at(fusion, content, next), next};
}

/// The state of a particle whose liquid fraction was f and whose temperature would be `trial` if f stayed.
/// Heated above t_melt f grows, cooled below t_solid it falls, and between the two it keeps (model 8.9). c_p
/// T + L f is kept. With L = 0 f jumps.
[[nodiscard]] inline ThermalState settled(const Fusion& fusion, double trial, double f) noexcept {
  assert(f >= 0.0 && f <= 1.0);
  if (fusion.soft_band)
    return {trial, std::clamp((trial - fusion.solidifies) / (fusion.melts - fusion.solidifies), 0.0, 1.0)};
  if (fusion.jump != 0.0) return settled_between_unlike(fusion, trial, f);
  double next = f;
  if (trial > fusion.melts && f < 1.0)
    next = fusion.heat > 0.0 ? std::min(1.0, f + (trial - fusion.melts) / fusion.heat) : 1.0;
  if (trial < fusion.solidifies && f > 0.0)
    next = fusion.heat > 0.0 ? std::max(0.0, f - (fusion.solidifies - trial) / fusion.heat) : 0.0;
  return {trial + fusion.heat * (f - next), next};
}

/// Whether a particle that is liquid, or solid, changes its phase at this liquid fraction.
[[nodiscard]] inline bool changes_phase(const Fusion& fusion, bool solid, double f) noexcept {
  if (solid) return f >= 1.0;
  return fusion.soft_band ? f < 1.0 : f <= 0.0;
}

/// Gives heat to one particle [J], of either sign, in the state of the form that is on (H, or as printed T).
/// A particle whose temperature is held hands the heat on to its holder. While a step of H is under way f
/// waits for its end, as for all other heat.
inline void give_heat(State& state, std::size_t row, double joules) {
  Particles& p = state.particles;
  if (p[field::held][row] != 0) {
    state.accumulated[account::walls] += joules;
    return;
  }
  const double capacity = p[field::mass][row] * p[field::heat_capacity][row];
  const Fusion fusion = fusion_of(state.scene, state.material_of(row));
  double& T = p[field::temperature][row];
  double none = 0.0;  // where nothing melts
  double& f = p.has(field::liquid_fraction.name) ? p[field::liquid_fraction][row] : none;
  if (p.has(field::enthalpy.name)) {
    double& H = p[field::enthalpy][row];
    H += joules;
    T = settled(fusion, temperature_at(fusion, H / capacity, f), f).temperature;
  } else {
    const ThermalState thermal = settled(fusion, T + joules / capacity, f);
    T = thermal.temperature;
    f = thermal.liquid_fraction;
  }
}

}  // namespace tripoint
