// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// Parts that both forms of heat share: material values of particles, and temperatures held from outside.
namespace tripoint::heat {

/// Heat capacity, temperature and held particles, from the scene and the sampled state.
/// @throws InputError naming the material without heat capacity or conductivity, or a scene without
/// temperatures
void load_common(State&, const InitialState&);
/// Columns of one particle. @throws InputError when its material does not conduct, or its temperature [K] is
/// not finite
void load_particle(State&, std::size_t row, double temperature);
/// Temperature of a particle that flowed in [K]; NaN where its inflow has none.
[[nodiscard]] double inflow_temperature(const State&, std::size_t row);

/// Sets one particle's temperature, and with it the state of the form that is on. @return heat given to it
/// [J]
using SetTemperature = double (*)(State&, std::size_t row, double temperature);

/// Liquid fraction of a particle; where nothing changes its phase, that of its phase.
[[nodiscard]] double liquid_share(const State&, std::size_t row);
/// m L f [J] of a particle of a scene that has phase change.
[[nodiscard]] double latent_heat(const State&, std::size_t row);
/// Melts or freezes a particle whose temperature is set from outside [K]; nothing where the scene has no
/// phase change.
void set_melted(State&, std::size_t row, double temperature);

/// Counts the heat that held particles hand on, body by body. The source that holds a body has given it the
/// heat that its neighbours took. @param change of a row [J]
template <class Change>
void accumulate_held(State& state, Change change) {
  if (!state.bodies.has(field::body_heat.name)) return;
  const auto held = state.particles[field::held], body = state.particles[field::body];
  const auto heat = state.bodies[field::body_heat];
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] != 0 && body[i] >= 0 && state.owns(i)) heat[static_cast<std::size_t>(body[i])] -= change(i);
}

/// An event `heat`: its particles take the temperature and hold it until the end; the heat given is
/// accumulated at the walls.
void hold_temperature(State&, const Happening&, SetTemperature);

}  // namespace tripoint::heat
