// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <optional>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

/// The temperatures that a scene can ever have. All heat comes from entries of its file: temperatures of
/// bodies and inflows, and held temperatures.
namespace tripoint {

/// Least and greatest temperature [K] that anything in a scene can reach. A step of conduction within its
/// bound keeps to the range of its neighbours (model 8.10, a discrete maximum principle). No effect but a
/// change of phase turns other energy into heat.
struct TemperatureRange {
  double least = INFINITY, greatest = -INFINITY;
  [[nodiscard]] bool empty() const noexcept { return !(least <= greatest); }
};
[[nodiscard]] TemperatureRange temperatures_of(const Scene&);

/// Temperature of a field at a place [K]; empty where its expression must be evaluated.
[[nodiscard]] std::optional<double> value_at(const TemperatureField&, const Vec3&);

/// Whether heat can flow in and out of a body: it has a temperature, and its material conducts.
[[nodiscard]] bool has_heat(const Body&, const Material&);

/// The one temperature [K] of a scene whose bodies, inflows and events all have the same: no heat flows, and
/// none ever will. Empty where they differ, a body has none or does not conduct, or something changes its
/// phase.
[[nodiscard]] std::optional<double> equal_temperature(const Scene&);

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
