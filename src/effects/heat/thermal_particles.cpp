// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/thermal_particles.hpp"

#include <algorithm>
#include <cmath>

#include "scene/geometry.hpp"

namespace tripoint::heat {
namespace {

[[nodiscard]] bool held_by_scene(const World& world, std::size_t row) {
  const auto source = static_cast<std::size_t>(world.particles[field::source][row]);
  return source < world.scene.bodies.size() && world.scene.bodies[source].temperature_held;
}

}  // namespace

void load_common(World& world, const InitialState& initial) {
  if (initial.temperature.size() != initial.size())
    throw InputError("the scene conducts heat, and has no temperatures: give each body a temperature");
  Particles& p = world.particles;
  const auto T = p[field::temperature], c_p = p[field::heat_capacity];
  const auto held = p[field::held];
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Material& material = world.material_of(i);
    if (!material.heat_capacity || !material.conductivity) {
      throw InputError("the scene conducts heat, and the material " + material.name +
                       " has no heat_capacity or no conductivity: give both");
    }
    c_p[i] = *material.heat_capacity;
    T[i] = initial.temperature[static_cast<std::size_t>(p[field::id][i])];
    if (!std::isfinite(T[i]))
      throw InputError("particle " + std::to_string(p[field::id][i]) + " has no temperature: give its body one");
    held[i] = held_by_scene(world, i);
  }
}

void hold_temperature(World& world, const Happening& now, SetTemperature set) {
  if (now.event.kind != Event::Kind::heat || !now.event.temperature) return;
  Particles& p = world.particles;
  const auto held = p[field::held];
  const auto inside = now.event.region ? inside_of(*now.event.region, world.scene.spacing) : [](const Vec3&) { return true; };
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    const auto source = static_cast<std::size_t>(p[field::source][i]);
    const auto& names = now.event.bodies;
    const bool named = names.empty() || std::find(names.begin(), names.end(), world.scene.bodies[source].name) != names.end();
    if (!named || !inside(world.unwrapped(i))) continue;
    if (now.begins) world.booked.walls -= set(p, i, *now.event.temperature);
    held[i] = now.begins || held_by_scene(world, i);
  }
}

}  // namespace tripoint::heat
