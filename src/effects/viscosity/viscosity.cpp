// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/viscosity/solid_viscosity.hpp"
#include "effects/viscosity/viscous_bound.hpp"
#include "effects/viscosity/viscous_form.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "liquids/predicted_velocities.hpp"
#include "liquids/scene_numbers.hpp"
#include "state/fill.hpp"

/// Viscosity of liquids and friction of solids that touch, (8): the force, and its bound of the step
/// (model 8.5).
namespace tripoint::viscosity {
namespace {

class Viscosity : public Effect {
 public:
  explicit Viscosity(const Scene& scene)
      : kernels_(liquid::pair_kernels(scene)),
        has_own_form_(!scene.has_brought_form(term::viscosity)),
        solid_viscosity_(scene) {}
  void load(State&, const InitialState&) override;
  void start_sums(State&, PassName, const Rows&) override;
  void state(State&, const Rows&) override;
  void after_states(State&, const Rows&) override;
  void happen(State& state, const Happening&) override { forget_bound(state); }
  void adopt(State&) override;
  [[nodiscard]] TimeStepBound max_dt(const State& state) const override {
    return {state.step_numbers[viscous_step], "viscosity"};
  }
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(State&, std::size_t row) const;
  void follow_temperature(State&) const;
  static void forget_bound(State& state) { state.step_numbers[viscous_age] = 0.0; }

  PairKernels kernels_;
  bool has_own_form_;  ///< no other effect brings the form of viscosity
  SolidViscosity solid_viscosity_;
};

void Viscosity::load(State& state, const InitialState&) {
  for (std::size_t i = 0; i < state.particles.size(); ++i) set_material(state, i);
  forget_bound(state);
}

void Viscosity::set_material(State& state, std::size_t row) const {
  Particles& p = state.particles;
  const auto source = static_cast<std::size_t>(p[field::source][row]);
  const bool slips = source < state.scene.bodies.size() && state.scene.bodies[source].free_slip;
  const double of_liquid = liquid::carries_density(state.scene) ? 0.0 : state.material_of(row).viscosity;
  p[field::viscosity][row] = p[field::body][row] < 0 ? of_liquid : solid_viscosity_(state, row);
  p[field::stick][row] = slips ? 0.0 : 1.0;
}

/// mu of solids between t_solid and t_melt. The bound of the step is looked at anew where one has changed.
void Viscosity::follow_temperature(State& state) const {
  const auto body = state.particles[field::body];
  const auto mu = state.particles[field::viscosity];
  bool changed = false;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] < 0) continue;
    const double now = solid_viscosity_(state, i);
    changed = changed || now != mu[i];
    mu[i] = now;
  }
  if (state.anywhere(changed)) forget_bound(state);
}

void Viscosity::adopt(State& state) {
  for (const std::uint32_t id : state.change.born) set_material(state, state.particles.row(id));
  for (const std::uint32_t id : state.change.regrouped) set_material(state, state.particles.row(id));
  forget_bound(state);
}

/// A form that another effect brings may add to the force without a pair term, to which the pass is blind.
void Viscosity::start_sums(State& state, PassName pass, const Rows& rows) {
  if (pass != PassName::rates || has_own_form_) return;
  for (const Field<double>* f : columns_of(field::viscous_force))
    fill(part(state.particles[*f], rows), 0.0, state.threads);
}

void Viscosity::state(State& state, const Rows&) {
  if (solid_viscosity_.follows_temperature()) follow_temperature(state);
  liquid::predict_velocities(state, state.step_numbers[liquid::half_step], field::viscous_velocity);
}

void Viscosity::after_states(State& state, const Rows&) {
  if (has_own_form_) update_viscous_bound(state, kernels_);
}

PairWork Viscosity::pair_work(const Scene& scene) const {
  PairWork work;
  if (has_own_form_ || liquid::carries_density(scene)) work.terms = {viscous_form_of(scene, kernels_).force};
  work.where_it_acts = true;
  return work;
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"viscosity",
               scene.mode_of(term::viscosity),
               {field::viscosity, field::stick, field::viscous_force, field::viscous_velocity},
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::mass, field::body, field::material, field::source, field::volume,
                                field::solid, field::group, field::force}})};
  s.reads_if_there = fields::joined({fields::image(), {field::liquid_fraction}});
  s.sums_forces = true;
  s.skips_sleeping = !scene.transport_velocity;
  Force force{field::viscous_force, {"viscous_work"}, EnergyAccount{"wall_viscous_work"}};
  force.entry = "viscous";
  s.forces = {force};
  s.step_numbers = {viscous_step, viscous_age};
  s.guarded_entries = {{"viscous", EntryRole::only_takes, "viscous forces, which may only take energy"}};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Viscosity>(scene); }

}  // namespace tripoint::viscosity
