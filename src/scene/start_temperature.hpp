// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// Whether a material has a thermal_expansion.
[[nodiscard]] inline bool expands(const Material& m) {
  return value_of(m.values, "thermal_expansion") != 0.0;
}

/// Temperature at which a material has its density and its length [K]: its expansion_temperature, else the
/// mean of its matter of this phase at the start, by mass.
[[nodiscard]] inline double expansion_temperature(const Scene& scene, const InitialState& initial,
                                                  std::size_t material, Phase phase) {
  const double stated = value_of(scene.materials[material].values, "expansion_temperature");
  if (stated > 0.0) return stated;
  double heat = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < initial.temperature.size(); ++i) {
    if (initial.material[i] != static_cast<int>(material) || initial.phase[i] != static_cast<int>(phase))
      continue;
    heat += initial.mass[i] * initial.temperature[i];
    mass += initial.mass[i];
  }
  return mass > 0.0 ? heat / mass : 0.0;
}

}  // namespace tripoint
