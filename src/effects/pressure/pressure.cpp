// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "core/machine.hpp"
#include "effects/effect.hpp"
#include "effects/pressure/bulk_viscosity.hpp"
#include "effects/pressure/compression_ledger.hpp"
#include "effects/pressure/let_out.hpp"
#include "effects/pressure/phase_jump.hpp"
#include "effects/pressure/pressure_state.hpp"
#include "effects/pressure/pressure_terms.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/groups.hpp"
#include "liquids/stored_compression.hpp"
#include "pairs/pass.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "state/body_table.hpp"
#include "state/fill.hpp"
#include "state/free_rows.hpp"

/// Pressure of liquids and of everything that touches, (7) and (9): equation of state, its force, its
/// numerical bulk viscosity (model 8.3, 8.4).
namespace tripoint::pressure {
namespace {

/// Energy of compression that changes of phase and of excluded pairs let go, and that letting solids out puts
/// in [J].
constexpr EnergyAccount compression_released{"compression_released"};

void set_material(State& state, std::size_t row) {
  Particles& p = state.particles;
  p[field::rest_density][row] = state.material_of(row).density;
  p[field::solid][row] = p[field::body][row] < 0 ? 0.0 : 1.0;
}

void set_groups(State& state) {
  const auto group = state.particles[field::group];
  const liquid::Groups group_of(state);
#pragma omp parallel for schedule(static) num_threads(state.threads) if (group.size() > worth_threads)
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(i);
}

class Pressure : public Effect {
 public:
  explicit Pressure(const Scene& scene)
      : numbers_(liquid::numbers_of(scene)),
        kernels_(liquid::pair_kernels(scene)),
        damps_(numbers_.bulk_viscosity > 0.0),
        lets_out_(liquid::lets_solids_out(scene)) {}
  void load(State&, const InitialState&) override;
  void kick(State&, double dt) override;
  void drift(State&, double dt) override;
  void state(State&, const Rows&) override;
  void after_states(State&, const Rows&) override;
  void form_fixed(State&, const Rows&) override;
  void happen(State& state, const Happening&) override { set_groups(state); }
  void adopt(State&) override;
  void check(const State& state) const override { refuse_overlap(state, numbers_); }
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State& state, Ledger& ledger) const override {
    if (liquid::stores_compression(state.scene)) add_compression(state, numbers_, ledger);
    if (lets_out_ && has_let_out(state)) ledger.energy["phase_work"] += 0.0;  // in every frame
    if (damps_) ledger.energy["bulk_viscous"] += state.accumulated[taken_by_bulk_viscosity];
  }
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void let_core_grow(State&, const Rows&);

  liquid::SceneNumbers numbers_;
  PairKernels kernels_;
  double drifted_ = 0.0;      ///< since the last forces, within a step [s]
  double core_before_ = 1.0;  ///< share of the core at the last forces, within a step [1]
  bool damps_;                ///< liquids have a numerical bulk viscosity
  bool lets_out_;             ///< solids may be pressed at the start
};

void Pressure::load(State& state, const InitialState&) {
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    set_material(state, i);
  }
  set_groups(state);
}

void Pressure::adopt(State& state) {
  state.accumulated[compression_released] -=
      compression_jump(state, numbers_, kernels_, liquid::Groups(state), 0.5 * drifted_);
  for (const std::uint32_t id : state.change.born) set_material(state, state.particles.row(id));
  for (const std::uint32_t id : state.change.regrouped) set_material(state, state.particles.row(id));
  set_groups(state);
}

void Pressure::kick(State& state, double dt) {
  drifted_ = 0.0;
  state.step_numbers[liquid::half_step] = dt;
}

void Pressure::drift(State& state, double dt) {
  drifted_ = dt;
  if (!lets_out_) return;
  core_before_ = liquid::core_share(state, numbers_);
  state.accumulated[compression_released] -= let_out(state, numbers_, dt);
}

void Pressure::state(State& state, const Rows& rows) {
  if (lets_out_) let_core_grow(state, rows);
  set_pressure(state, numbers_, rows);
  if (damps_ && state.moved) set_bulk_pressure(state, numbers_);
}

/// The core of pairs as it is now, and the energy that its growth since the last forces puts in.
void Pressure::let_core_grow(State& state, const Rows& rows) {
  if (state.step_numbers[liquid::let_out_for] < 0.0) {
    take_as_rest(state, rows);
    begin_letting_out(state, numbers_);
  }
  const double share = liquid::core_share(state, numbers_);
  if (share > core_before_)
    state.accumulated[compression_released] -= core_energy(state, numbers_, share - core_before_);
  core_before_ = share;
  kernels_.core.stiffness = share * numbers_.core_stiffness;
}

void Pressure::after_states(State& state, const Rows& rows) {
  if (state.scene.mode_of(term::pressure) == Mode::corrected) set_pressure_shares(state, numbers_, rows);
}

void Pressure::form_fixed(State& state, const Rows& rows) {
  if (!damps_) return;
  Particles& p = state.particles;
  std::ranges::copy(part(p[field::number_density], rows),
                    part(p[field::number_density_before], rows).begin());
}

/// Sound C h/(c + |v|), C of the form, and the numerical bulk viscosity, which binds above its default alone
/// (model 8.10).
TimeStepBound Pressure::max_dt(const State& state) const {
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
  return bound;
}

PairWork Pressure::pair_work(const Scene& scene) const {
  PairWork work{{scene.mode_of(term::pressure) == Mode::paper ? pair_term<PressurePaper>
                 : liquid::carries_density(scene)             ? pair_term<PressureOfSolids>
                                                              : pair_term<PressureCorrected>}};
  work.where_it_acts = true;
  work.kernels = &kernels_;
  return work;
}

/// Where its work goes (model 8.11).
Force force_of(const Scene& scene) {
  Force pressure{field::force, {"pressure_work"}, EnergyAccount{"wall_pressure_work"}};
  if (liquid::stores_compression(scene))
    pressure.stored =
        StoredEnergy{{"compression"}, {"start_compression"}, compression_released, "phase_work"};
  else
    pressure.entry = "pressure_work";
  return pressure;
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"pressure",
               scene.mode_of(term::pressure),
               {field::pressure, field::rest_density, field::solid, field::group, field::force},
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::id, field::mass, field::body, field::material, field::source,
                                field::density, field::volume}})};
  s.reads_if_there =
      fields::joined({fields::image(), {field::number_density, field::own_density, field::bulk_pressure}});
  s.skips_sleeping = !scene.transport_velocity;
  const bool damps = bulk_viscosity(scene) > 0.0;
  const auto own = [&](std::initializer_list<FieldInfo> more) { s.owns.insert(s.owns.end(), more); };
  if (scene.mode_of(term::pressure) == Mode::corrected) own({field::pressure_share});
  if (damps) own({field::number_density_before, field::bulk_pressure});
  s.forces = {force_of(scene)};
  s.accounts = {compression_released};
  s.step_numbers = {liquid::half_step};
  if (liquid::lets_solids_out(scene))
    s.step_numbers.insert(s.step_numbers.end(), {liquid::let_out_for, liquid::core_let_out_for});
  if (!liquid::stores_compression(scene))
    s.guarded_entries = {
        {"pressure_work", EntryRole::unbacked, "the printed pressure, which no energy stands behind"}};
  if (damps) s.numerical = {taken_by_bulk_viscosity};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Pressure>(scene); }

}  // namespace tripoint::pressure
