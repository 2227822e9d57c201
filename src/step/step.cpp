// SPDX-License-Identifier: BSD-3-Clause
// The step: kick, drift, kick (docs/model.md, chapter 9). What a stage does is in the effects; here is the
// order.
#include <utility>

#include "scene/shared_terms.hpp"
#include "state/drop_particles.hpp"
#include "step/each_effect.hpp"
#include "step/guard.hpp"
#include "step/ledger_sum.hpp"
#include "step/simulation.hpp"
#include "step/step_length.hpp"

namespace tripoint {

/// Rates and dt_ hold for the time on entry, and again on exit, at `end` [s].
void Simulation::step(double end) {
  state_.next_time = end;
  if (!leaves_out_first_kick()) kick(0.5 * dt_);  // v of particles, v and L of rigid bodies (18)
  // r; rotation (19), (20); prescribed motion; T or H by its rate (21)
  drift(dt_);
  state_.time = end;
  form_rates();
  correct();        // second stage of heat
  kick(0.5 * dt_);  // by the rates of `end`
  ++steps_;
  check();
}

/// All rates of the present state: forces, torques and flows of heat.
void Simulation::form_rates() {
  // Fig. 5: melt, solidify, merge, split, fracture, before any rate of the new time
  change();
  find_neighbours();                          // lists, where a particle has moved by half the skin
  if (state_.moved) pass(PassName::density);  // (4), moments: of places only
  form_states();                              // (9), walls; strain and stress (11), (14), (15), plastic flow
  state_.moved = false;
  pass(PassName::rates);  // (7), (8), (21)
  sum_bonds();            // (12), hourglass
  state_.fixed_formed = state_.particles.moving() == state_.particles.size();
}

/// What no step reads of fixed particles, at the present time: the forces on them, and densities behind the
/// faces of walls. It is formed where somebody asks (decision 028).
void Simulation::form_fixed() {
  if (state_.fixed_formed) return;
  state_.fixed_formed = state_.forms_fixed = true;
  state_.neighbours->list_sleeping();
  const auto each = [&](auto visit) { for_each_effect(state_, effects_, visit); };
  const auto sum_fixed = [&](PassName name) {
    start_sums(name);
    passes_.run_fixed(name, state_);
  };
  if (!state_.unread.empty()) sum_fixed(PassName::density);
  each([&](Effect& effect) { effect.form_fixed(state_, state_.formed()); });
  sum_fixed(PassName::rates);
  for_each_effect(state_, effects_, &OwnSums::bonds,
                  [&](Effect& effect) { effect.bonds(state_, state_.formed()); });
  state_.forms_fixed = false;
}

/// One step towards `time` [s], then the events of its end.
void Simulation::move_on(double time) {
  choose_step(schedule_.stop_before(time));
  step(schedule_.next_end(dt_));
  schedule_.count_step();
  happen_until_now();
  if (state_.scene.recovers && steps_ % Recovery::steps_between_states == 0) keep_good_state();
}

/// Steps stay equal up to `stop` [s], but for a bound that has shrunk below them.
void Simulation::choose_step(double stop) {
  const StageTimer timer(options_.stage_seconds, Stage::bound);
  if (!schedule_.needs_plan(stop) && !(least_bound(state_, effects_).dt < dt_)) return;
  set_bound();
  check_step(state_, bound_, guards_);
  dt_ = schedule_.plan(state_.time, stop, steps_to(state_, stop, bound_, recovery_.share()));
}

/// One call of each effect, as for_each_effect(), timed as that stage.
template <class... How>
void Simulation::each_effect(Stage stage, How... how) {
  const StageTimer timer(options_.stage_seconds, stage);
  for_each_effect(state_, effects_, how...);
}

// Inlined where they are called: the step of a small scene takes 0.4 % less.
inline void Simulation::kick(double dt) {
  each_effect(Stage::kick, [&](Effect& effect) { effect.kick(state_, dt); });
}

inline void Simulation::drift(double dt) {
  each_effect(Stage::drift, [&](Effect& effect) { effect.drift(state_, dt); });
}

inline void Simulation::form_states() {
  const Rows rows = state_.awake();
  if (state_.moved)
    each_effect(Stage::state, &OwnSums::densities, [&](Effect& effect) { effect.densities(state_, rows); });
  each_effect(Stage::state, &OwnSums::state, [&](Effect& effect) { effect.state(state_, rows); });
  each_effect(Stage::state, [&](Effect& effect) { effect.after_states(state_, rows); });
}

inline void Simulation::sum_bonds() {
  each_effect(Stage::bonds, &OwnSums::bonds, [&](Effect& effect) { effect.bonds(state_, state_.formed()); });
}

/// One pass over pairs, where the scene has any.
void Simulation::pass(PassName name) {
  if (!passes_.needed()) return;
  const StageTimer timer(options_.stage_seconds, name == PassName::density ? Stage::density : Stage::rates);
  sum(name);
}

/// Fixed walls have densities, and no forces.
void Simulation::start_sums(PassName name) {
  const Particles& p = state_.particles;
  const Rows asleep{p.awake(), p.size()};
  const Rows rows = name != PassName::density ? state_.formed()
                    : state_.forms_fixed      ? asleep
                                              : state_.awake();
  if (name == PassName::density)
    for_each_effect(state_, effects_, [&](Effect& effect) { effect.decide_sums(state_); });
  passes_.start_sums(name, state_, rows);
  for_each_effect(state_, effects_, [&](Effect& effect) { effect.start_sums(state_, name, rows); });
}

void Simulation::sum(PassName name) {
  start_sums(name);
  passes_.run(name, state_);
  if (name != PassName::density) pairs_ += static_cast<double>(state_.neighbours->entries());
}

/// What changes its phase, its body or its lists: decided by some effects, followed by all, and then settled.
void Simulation::change() {
  const StageTimer timer(options_.stage_seconds, Stage::change);
  state_.change.clear();
  for (const Active& a : effects_) {
    if (!a.spec.changes || !wants_change(a)) continue;
    {
      const DeclaredView view(state_, a);
      a.effect->change(state_);
    }
    if (!state_.change.leaving.empty()) let_go();
  }
  if (state_.change.empty()) return;
  for_each_effect(state_, effects_, [&](Effect& effect) { effect.adopt(state_); });
  for_each_effect(state_, effects_, [&](Effect& effect) { effect.settle(state_); });
  state_.moved = true;
}

/// Particles leave the scene: their energies are accumulated, and the others are numbered and listed anew.
void Simulation::let_go() {
  const std::vector<std::uint32_t> leaving = std::exchange(state_.change.leaving, {});
  std::vector<std::size_t> rows;
  for (const std::uint32_t id : leaving) rows.push_back(state_.particles.row(id));
  for_each_effect(state_, effects_, [&](Effect& effect) { effect.lose(state_, rows); });
  drop_particles(state_, leaving);
  for (const Active& a : effects_) a.effect->renumber(state_);
  state_.change.left = true;
  find_neighbours();
}

/// Whether an effect has something to decide, in any of the processes that share the scene. Each then holds
/// the whole of it until it is shared out again, with the lists.
bool Simulation::wants_change(const Active& a) {
  bool wants = false;
  {
    const DeclaredView view(state_, a);
    wants = a.effect->wants_change(state_);
  }
  if (!state_.halo) return wants;
  if (!sharing_.any(wants)) return false;
  sharing_.gather(state_, effects_);
  return true;
}

void Simulation::find_neighbours() {
  const StageTimer timer(options_.stage_seconds, Stage::search);
  if (options_.halo) sharing_.follow(state_, effects_, passes_);
  if (!state_.neighbours) return;
  state_.neighbours->update(state_.particles, state_.time, [this] { return resting(); });
  if (state_.halo && !state_.neighbours->marked()) mark_copies(state_);
  if (state_.neighbours->marked() && state_.change.empty()) return;
  state_.neighbours->mark_own(state_.particles, state_.own);
  passes_.drop_clusters();
}

/// The second stage of two-stage schemes, and where one asks for it the rates of heat at the predicted state.
void Simulation::correct() {
  const StageTimer timer(options_.stage_seconds, Stage::correct);
  bool again = false;
  for_each_effect(state_, effects_, [&](Effect& effect) { again = effect.correct(state_, dt_) || again; });
  if (again && passes_.needed()) sum(PassName::again);
}

/// Guards, none of which changes anything; energy is summed over all particles and bonds, so only now and
/// then.
void Simulation::check() {
  constexpr long steps_between_ledgers = 128;
  const StageTimer timer(options_.stage_seconds, Stage::check);
  sharing_.look_together(state_, [this] { check_particles(); });
  if (steps_ % steps_between_ledgers != 0) return;
  double start_potential = state_.accumulated[account::start_potential];
  if (state_.halo) state_.halo->add({&start_potential, 1});
  check_energy(state_, ledger(), start_potential, dt_, guards_);
}

void Simulation::check_particles() {
  constexpr long steps_between_looks = 32;
  check_finite(state_);
  if (enclosure_.given || steps_ % steps_between_looks == 0) check_escape(state_, enclosure_);
  for_each_effect(state_, effects_, [&](const Effect& effect) { effect.check(state_); });
}

/// The paper's leapfrog starts a run so.
bool Simulation::leaves_out_first_kick() const {
  return steps_ == 0 && state_.scene.mode_of(term::time) == Mode::paper;
}

/// Events of the present time, between two steps: the state is whole, and rates are then formed anew.
void Simulation::happen_until_now() {
  bool any = false;
  while (const Schedule::Moment* const m = schedule_.next_until(state_.time)) {
    sharing_.gather(state_, effects_);
    const Happening now{state_.scene.events[m->event], m->begins};
    for_each_effect(state_, effects_, [&](Effect& effect) { effect.happen(state_, now); });
    any = true;
  }
  if (!any) return;
  state_.moved = true;
  passes_.drop_clusters();
  form_rates();
  sharing_.look_together(state_, [this] { check_finite(state_); });
}

}  // namespace tripoint
