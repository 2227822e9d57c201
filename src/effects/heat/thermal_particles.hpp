// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

/// What both forms of heat share: material values of particles, and temperatures held from outside.
namespace tripoint::heat {

/// Heat capacity, temperature and what is held, from the scene and the sampled state.
/// @throws InputError naming the material without heat capacity or conductivity, or a scene without temperatures
void load_common(World&, const InitialState&);

/// Sets one particle's temperature, and with it the state of the form that is on. @return heat given to it [J]
using SetTemperature = double (*)(Particles&, std::size_t row, double temperature);

/// An event `heat`: its particles take the temperature and hold it until the end; the heat given is booked at the walls.
void hold_temperature(World&, const Happening&, SetTemperature);

}  // namespace tripoint::heat
