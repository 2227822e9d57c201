// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine.hpp"
#include "effects/fluid/bulk_viscosity.hpp"
#include "effects/fluid/fluid_ledger.hpp"
#include "effects/fluid/fluid_state.hpp"
#include "effects/fluid/phase_jump.hpp"
#include "effects/fluid/solid_viscosity.hpp"
#include "effects/fluid/viscous_bound.hpp"
#include "effects/fluid/viscous_form.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/groups.hpp"
#include "liquids/predicted_velocities.hpp"
#include "liquids/stored_compression.hpp"
#include "pairs/pass.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "state/body_table.hpp"
#include "state/fill.hpp"
#include "state/free_rows.hpp"

namespace tripoint::fluid {
namespace {

// Share of h/(c + |v|) that a step of sound takes [1]. With these both forms take 0.47 to 0.52 of the longest
// stable step, as measured (docs/guards.md).
constexpr double courant_printed = 0.7, courant_corrected = 0.45;
/// The background pressure of the transport velocity adds half to the stiffness: 0.45/sqrt(1.5) = 0.37,
/// rounded down.
constexpr double courant_transported = 0.35;

/// Energy of compression that changes of phase and of own pairs let go [J].
constexpr EnergyAccount compression_released{"compression_released"};

class Fluid : public Effect {
 public:
  explicit Fluid(const Scene& scene)
      : numbers_(liquid::numbers_of(scene)),
        kernels_(liquid::pair_kernels(scene)),
        damps_(numbers_.bulk_viscosity > 0.0),
        solid_viscosity_(scene) {}
  void load(State&, const InitialState&) override;
  void kick(State&, double dt) override;
  void drift(State&, double dt) override;
  void clear(State&, PassName) override;
  void state(State&) override;
  void after_states(State&) override;
  void form_fixed(State&) override;
  void happen(State& state, const Happening&) override { set_groups(state); }
  void adopt(State&) override;
  void check(const State& state) const override { refuse_overlap(state, numbers_); }
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State& state, Ledger& ledger) const override {
    if (liquid::stores_compression(state.scene)) add_fluid(state, numbers_, kernels_, ledger);
    if (damps_) ledger.energy["bulk_viscous"] += state.accumulated[taken_by_bulk_viscosity];
  }
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(State&, std::size_t row) const;
  void set_groups(State&);
  void follow_temperature(State&) const;

  liquid::SceneNumbers numbers_;
  PairKernels kernels_;
  double drifted_ = 0.0;  ///< since the last forces, within a step [s]
  bool damps_;            ///< liquids have a numerical bulk viscosity
  SolidViscosity solid_viscosity_;
};

void Fluid::load(State& state, const InitialState&) {
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    set_material(state, i);
  }
  set_groups(state);
}

void Fluid::set_material(State& state, std::size_t row) const {
  Particles& p = state.particles;
  const auto source = static_cast<std::size_t>(p[field::source][row]);
  const bool slips = source < state.scene.bodies.size() && state.scene.bodies[source].free_slip;
  const bool liquid = p[field::body][row] < 0;
  p[field::rest_density][row] = state.material_of(row).density;
  p[field::solid][row] = liquid ? 0.0 : 1.0;
  const double of_liquid = liquid::carries_density(state.scene) ? 0.0 : state.material_of(row).viscosity;
  p[field::viscosity][row] = liquid ? of_liquid : solid_viscosity_(state, row);
  p[field::stick][row] = slips ? 0.0 : 1.0;
}

/// mu of solids between t_solid and t_melt. The bound of the step is looked at anew where one has changed.
void Fluid::follow_temperature(State& state) const {
  const auto body = state.particles[field::body];
  const auto mu = state.particles[field::viscosity];
  double changed = 0.0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] < 0) continue;
    const double now = solid_viscosity_(state, i);
    if (now != mu[i]) changed = 1.0;
    mu[i] = now;
  }
  if (state.halo) state.halo->add({&changed, 1});
  if (changed > 0.0) state.step_numbers[viscous_age] = 0.0;
}

void Fluid::adopt(State& state) {
  state.accumulated[compression_released] -=
      compression_jump(state, numbers_, kernels_, liquid::Groups(state), 0.5 * drifted_);
  for (const std::uint32_t id : state.change.born) set_material(state, state.particles.row(id));
  for (const std::uint32_t id : state.change.regrouped) set_material(state, state.particles.row(id));
  set_groups(state);
}

void Fluid::set_groups(State& state) {
  const auto group = state.particles[field::group];
  const liquid::Groups group_of(state);
#pragma omp parallel for schedule(static) num_threads(state.threads) if (group.size() > worth_threads)
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(i);
  state.step_numbers[viscous_age] = 0.0;
}

void Fluid::kick(State& state, double dt) {
  drifted_ = 0.0;
  state.step_numbers[liquid::half_step] = dt;
}

void Fluid::drift(State&, double dt) { drifted_ = dt; }

void Fluid::clear(State& state, PassName pass) {
  if (pass != PassName::rates) return;
  Particles& p = state.particles;
  for (const VectorField<double>& force : {field::force, field::viscous_force})
    for (const Field<double>* f : columns_of(force)) fill(part(p[*f], state.formed()), 0.0, state.threads);
}

void Fluid::state(State& state) {
  if (solid_viscosity_.follows_temperature()) follow_temperature(state);
  set_pressure(state, numbers_);
  if (damps_ && state.moved) set_bulk_pressure(state, numbers_);
  liquid::predict_velocities(state, state.step_numbers[liquid::half_step], field::viscous_velocity);
}

void Fluid::after_states(State& state) {
  if (state.scene.mode_of(term::pressure) == Mode::corrected) set_pressure_shares(state, numbers_);
  if (!state.scene.has_brought_form(term::viscosity)) update_viscous_bound(state, kernels_);
}

void Fluid::form_fixed(State& state) {
  if (!damps_) return;
  Particles& p = state.particles;
  const Rows fixed = state.formed();
  std::ranges::copy(part(p[field::number_density], fixed),
                    part(p[field::number_density_before], fixed).begin());
}

/// Sound C h/(c + |v|), C of the form; viscosity, and the numerical bulk viscosity, which binds above its
/// default alone (model 8.10).
TimeStepBound Fluid::max_dt(const State& state) const {
  const double fastest = liquid::greatest_speed(state);
  TimeStepBound bound{numbers_.courant * state.support() / (numbers_.sound_speed + fastest), "sound"};
  if (damps_)
    tighten(bound,
            bulk_viscous_step(numbers_.bulk_viscosity) * state.support() / (numbers_.sound_speed + fastest),
            "bulk viscosity");
  if (numbers_.sound_damping > 0.0)  // the background pressure adds to the stiffness here too
    tighten(bound,
            numbers_.courant / liquid::courant_corrected * bulk_viscous_step(numbers_.sound_damping) *
                state.support() / (numbers_.sound_speed + fastest),
            "bulk viscosity");
  tighten(bound, state.step_numbers[viscous_step], "viscosity");
  return bound;
}

PairWork Fluid::pair_work(const Scene& scene) const {
  const auto printed = [&](const Term& one) { return scene.mode_of(one) == Mode::paper; };
  const bool solids_alone = liquid::carries_density(scene);
  PairWork work{{printed(term::pressure) ? pair_term<PressurePaper>
                 : solids_alone          ? pair_term<PressureOfSolids>
                                         : pair_term<PressureCorrected>}};
  if (solids_alone || !scene.has_brought_form(term::viscosity))
    work.terms.push_back(viscous_form_of(scene, kernels_).force);
  work.where_it_acts = true;
  work.kernels = &kernels_;
  return work;
}

/// Pressure and viscosity, with where their work goes (model 8.11).
std::vector<Force> forces_of(const Scene& scene) {
  Force pressure{
      field::force_x, field::force_y, field::force_z, {"pressure_work"}, EnergyAccount{"wall_pressure_work"}};
  if (liquid::stores_compression(scene))
    pressure.stored =
        StoredEnergy{{"compression"}, {"start_compression"}, compression_released, "phase_work"};
  else
    pressure.entry = "pressure_work";
  Force viscous{field::viscous_force_x,
                field::viscous_force_y,
                field::viscous_force_z,
                {"viscous_work"},
                EnergyAccount{"wall_viscous_work"}};
  viscous.entry = "viscous";
  return {pressure, viscous};
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"fluid",
               scene.mode_of(term::pressure),
               {field::pressure, field::rest_density, field::viscosity, field::solid, field::stick,
                field::group, field::force, field::viscous_force, field::viscous_velocity},
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::id, field::mass, field::body, field::material, field::source,
                                field::density, field::volume}})};
  s.reads_if_there = fields::joined(
      {fields::image(),
       {field::liquid_fraction, field::number_density, field::own_density, field::bulk_pressure}});
  s.sums_forces = true;
  s.skips_sleeping = !scene.transport_velocity;
  const bool damps = bulk_viscosity(scene) > 0.0;
  const auto own = [&](std::initializer_list<FieldInfo> more) { s.owns.insert(s.owns.end(), more); };
  if (scene.mode_of(term::pressure) == Mode::corrected) own({field::pressure_share});
  if (damps) own({field::number_density_before, field::bulk_pressure});
  s.forces = forces_of(scene);
  s.accounts = {compression_released};
  s.step_numbers = {liquid::half_step, viscous_step, viscous_age};
  s.guarded_entries = {{"viscous", EntryRole::only_takes, "viscous forces, which may only take energy"}};
  if (!liquid::stores_compression(scene))
    s.guarded_entries.push_back(
        {"pressure_work", EntryRole::unbacked, "the printed pressure, which no energy stands behind"});
  if (damps) s.numerical = {taken_by_bulk_viscosity};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Fluid>(scene); }

}  // namespace tripoint::fluid
