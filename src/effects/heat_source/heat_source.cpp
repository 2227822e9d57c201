// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <vector>

#include "effects/effect.hpp"
#include "scene/geometry.hpp"
#include "solids/fusion.hpp"

/// Heat that [[source]] gives to a volume (model 8.6): dH = q V dt, V = m/rho0, over the part of the step in
/// which the source is on. It is part of the first stage of the step of heat, so that the whole stays of
/// second order.
namespace tripoint::heat_source {
namespace {

namespace account {
constexpr EnergyAccount given{"heat_source"};  ///< heat given [J]
}

using Inside = std::function<bool(const Vec3&)>;

struct Heater {
  Inside inside;
  std::vector<char> heats;  ///< of each body of the scene, and then each inflow, 1 where it is heated
  double density = 0.0;     ///< [W/m3]
  double start = 0.0, stop = 0.0;
};

/// Volume of what it heats at the start [m3].
double volume_at_start(const Heater& h, const Scene& scene, const InitialState& initial) {
  double sum = 0.0;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (h.heats[static_cast<std::size_t>(initial.source[i])] && h.inside(initial.position[i]))
      sum += initial.mass[i] / scene.materials[static_cast<std::size_t>(initial.material[i])].density;
  return sum;
}

Heater heater_of(const HeatSource& source, const Scene& scene, const InitialState& initial) {
  Heater h;
  h.inside = source.region ? inside_region(scene, *source.region) : [](const Vec3&) { return true; };
  h.heats.assign(scene.bodies.size() + scene.inflows.size(), source.bodies.empty() ? 1 : 0);
  for (std::size_t n = 0; n < scene.bodies.size(); ++n)
    if (std::ranges::find(source.bodies, scene.bodies[n].name) != source.bodies.end()) h.heats[n] = 1;
  h.start = source.start;
  h.stop = source.stop;
  h.density = source.density.value_or(0.0);
  if (!source.heat) return h;
  const double volume = volume_at_start(h, scene, initial);
  if (!(volume > 0.0))
    throw InputError(source.place,
                     "no particle is in the region of the source at the start: give heat_density");
  h.density = *source.heat / volume;
  return h;
}

class Heating : public Effect {
 public:
  void load(State&, const InitialState&) override;
  void drift(State&, double dt) override;
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["heat_source"] -= state.accumulated[account::given];
  }

 private:
  std::vector<Heater> heaters_;
};

void Heating::load(State& state, const InitialState& initial) {
  heaters_.clear();
  for (const HeatSource& source : state.scene.sources)
    if (!source.is_of_surfaces()) heaters_.push_back(heater_of(source, state.scene, initial));
}

void Heating::drift(State& state, double) {
  Particles& p = state.particles;
  for (const Heater& h : heaters_) {
    const double seconds = std::min(state.next_time, h.stop) - std::max(state.time, h.start);
    if (!(seconds > 0.0)) continue;
    for (std::size_t id = 0; id < p.size(); ++id) {
      const std::size_t i = p.row(id);
      if (!h.heats[static_cast<std::size_t>(p[field::source][i])] || !h.inside(state.unwrapped(i))) continue;
      const double heat = h.density * seconds * p[field::mass][i] / state.material_of(i).density;
      give_heat(state, i, heat);
      if (state.owns(i)) state.accumulated[account::given] += heat;
    }
  }
}

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"heat_source",
               Mode::corrected,
               {},
               fields::joined({fields::position(),
                               {field::id, field::mass, field::material, field::source, field::temperature,
                                field::heat_capacity, field::held}})};
  s.accounts = {account::given};
  s.reads_if_there = fields::joined({fields::image(), {field::enthalpy, field::liquid_fraction}});
  return s;
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<Heating>(); }

}  // namespace tripoint::heat_source
