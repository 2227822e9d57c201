// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>
#include <vector>

#include "effects/effect.hpp"
#include "scene/temperatures.hpp"

/// Thermal buoyancy of liquids [Boussinesq 1903]: F = -m b (T - T0) g on each liquid particle (model 8.13), b
/// of its material. The density in all other terms stays that of T0.
namespace tripoint::buoyancy {
namespace {

constexpr VectorField<double> force{"buoyancy_force", "N"};

struct Expansion {
  double coefficient = 0.0, temperature = 0.0;  ///< [1/K], [K]
};

class Buoyancy : public Effect {
 public:
  void load(State&, const InitialState&) override;
  void bonds(State&, const Rows&) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;

 private:
  std::vector<Expansion> of_material_;
};

void Buoyancy::load(State& state, const InitialState& initial) {
  of_material_.clear();
  for (std::size_t n = 0; n < state.scene.materials.size(); ++n) {
    of_material_.push_back({value_of(state.scene.materials[n].values, "thermal_expansion"),
                            expansion_temperature(state.scene, initial, n, Phase::liquid)});
  }
}

void Buoyancy::bonds(State& state, const Rows&) {
  const Particles& p = std::as_const(state.particles);
  const auto F = triple(state.particles, force);
  const auto m = p[field::mass], T = p[field::temperature];
  const auto material = p[field::material], phase = p[field::phase];
  for (std::size_t i = 0; i < m.size(); ++i) {
    const Expansion& e = of_material_[static_cast<std::size_t>(material[i])];
    const bool liquid = phase[i] == static_cast<int>(Phase::liquid);
    F.set(i, liquid ? -m[i] * e.coefficient * (T[i] - e.temperature) * state.scene.gravity : Vec3{});
  }
}

TimeStepBound Buoyancy::max_dt(const State& state) const {
  const auto T = state.particles[field::temperature];
  const auto material = state.particles[field::material];
  double most = 0.0;
  for (std::size_t i = 0; i < T.size(); ++i) {
    const Expansion& e = of_material_[static_cast<std::size_t>(material[i])];
    most = std::max(most, std::abs(e.coefficient * (T[i] - e.temperature)));
  }
  TimeStepBound bound;
  if (most > 0.0)
    tighten(bound, acceleration_step(state.support(), most * norm(state.scene.gravity)), "buoyancy");
  return bound;
}

}  // namespace

EffectSpec spec(const Scene&) {
  Force buoyancy{force, {"buoyancy_work"}, EnergyAccount{"wall_buoyancy_work"}};
  buoyancy.entry = "buoyancy";
  return {"buoyancy",
          Mode::corrected,
          {force},
          {field::mass, field::material, field::phase, field::temperature},
          {buoyancy}};
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<Buoyancy>(); }

}  // namespace tripoint::buoyancy
