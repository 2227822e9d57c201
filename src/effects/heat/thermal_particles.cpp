// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/thermal_particles.hpp"

#include <algorithm>
#include <cmath>

#include "core/not_a_number.hpp"
#include "scene/geometry.hpp"
#include "solids/fusion.hpp"

namespace tripoint::heat {
namespace {

[[nodiscard]] bool held_by_scene(const State& state, std::size_t row) {
  const auto source = static_cast<std::size_t>(state.particles[field::source][row]);
  return source < state.scene.bodies.size() && state.scene.bodies[source].temperature_held;
}

}  // namespace

void load_common(State& state, const InitialState& initial) {
  if (initial.temperature.size() != initial.size())
    throw InputError("the scene conducts heat, and has no temperatures: give each body a temperature");
  for (std::size_t i = 0; i < state.particles.size(); ++i)
    load_particle(state, i, initial.temperature[static_cast<std::size_t>(state.particles[field::id][i])]);
}

void load_particle(State& state, std::size_t row, double temperature) {
  Particles& p = state.particles;
  const Material& material = state.material_of(row);
  if (!material.heat_capacity || !material.conductivity) {
    throw InputError("the scene conducts heat, and the material " + material.name +
                     " has no heat_capacity or no conductivity: give both");
  }
  const bool liquid = p[field::phase][row] == static_cast<int>(Phase::liquid);
  p[field::heat_capacity][row] =
      !p.has(field::liquid_fraction.name) && liquid ? *material.heat_capacity : solid_capacity(material);
  p[field::temperature][row] = temperature;
  if (!std::isfinite(temperature))
    throw InputError("particle " + std::to_string(p[field::id][row]) +
                     " has no temperature: give its body or inflow one");
  p[field::held][row] = held_by_scene(state, row);
  if (!p.has(field::liquid_fraction.name)) return;
  p[field::liquid_fraction][row] = liquid ? 1.0 : 0.0;
  if (const Fusion fusion = fusion_of(state.scene, material); fusion.soft_band)
    p[field::liquid_fraction][row] = settled(fusion, temperature, 0.0).liquid_fraction;
}

double liquid_share(const State& state, std::size_t row) {
  const Particles& p = state.particles;
  if (p.has(field::liquid_fraction.name)) return p[field::liquid_fraction][row];
  return p[field::phase][row] == static_cast<int>(Phase::liquid) ? 1.0 : 0.0;
}

double latent_heat(const State& state, std::size_t row) {
  const Particles& p = state.particles;
  return p[field::mass][row] * p[field::heat_capacity][row] *
         fusion_of(state.scene, state.material_of(row)).heat * p[field::liquid_fraction][row];
}

void set_melted(State& state, std::size_t row, double temperature) {
  if (!state.particles.has(field::liquid_fraction.name)) return;
  const Fusion fusion = fusion_of(state.scene, state.material_of(row));
  double& f = state.particles[field::liquid_fraction][row];
  if (fusion.soft_band)
    f = settled(fusion, temperature, f).liquid_fraction;
  else if (temperature > fusion.melts)
    f = 1.0;
  else if (temperature < fusion.solidifies)
    f = 0.0;
}

double inflow_temperature(const State& state, std::size_t row) {
  const auto source = static_cast<std::size_t>(state.particles[field::source][row]);
  return state.scene.inflows.at(source - state.scene.bodies.size()).temperature.value_or(not_a_number);
}

void hold_temperature(State& state, const Happening& now, SetTemperature set) {
  if (now.event.kind != Event::Kind::heat || !now.event.temperature) return;
  Particles& p = state.particles;
  const auto held = p[field::held];
  const auto inside =
      now.event.region ? inside_region(state.scene, *now.event.region) : [](const Vec3&) { return true; };
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    const auto source = static_cast<std::size_t>(p[field::source][i]);
    const auto& names = now.event.bodies;
    const bool named = names.empty() || (source < state.scene.bodies.size() &&
                                         std::find(names.begin(), names.end(),
                                                   state.scene.bodies[source].name) != names.end());
    if (!named || !inside(state.unwrapped(i))) continue;
    if (now.begins) {
      const double given = set(state, i, *now.event.temperature);
      state.accumulated[account::walls] -= given;
      if (const int b = p[field::body][i]; b >= 0 && state.bodies.has(field::body_heat.name))
        state.bodies[field::body_heat][static_cast<std::size_t>(b)] += given;
    }
    held[i] = now.begins || held_by_scene(state, i);
  }
}

}  // namespace tripoint::heat
