// SPDX-License-Identifier: BSD-3-Clause
#include "step/simulation.hpp"

#include "step/ledger_sum.hpp"
#include "step/resting.hpp"
#include "step/step_length.hpp"

namespace tripoint {

Simulation::Simulation(const Scene& scene, const InitialState& initial, const SimulationOptions& options)
    : options_(options),
      effects_(active_effects(scene)),
      passes_(scene, pair_work(scene, effects_), options.lanes, options.sums_all) {
  set_up(scene, initial);
  if (scene.recovers) start_ = initial;
  form_rates();
  check_finite(state_);
  set_bound();
  refuse_endless_run(scene, bound_);
  accumulate_start(state_, own_ledger(state_, effects_));
  happen_until_now();
  keep_good_state();
}

Simulation::Simulation(const Scene& scene, const InitialState& initial, const SimulationOptions& options,
                       const Checkpoint& checkpoint)
    : options_(options),
      effects_(active_effects(scene)),
      passes_(scene, pair_work(scene, effects_), options.lanes, options.sums_all) {
  set_up(scene, initial);
  if (scene.recovers) {
    start_ = initial;
    recovery_.restore(checkpoint);
  }
  restore(checkpoint);
}

bool Simulation::advance_to(double time, const std::function<bool()>& go_on) {
  const bool reached = go_towards(time, go_on);
  form_fixed();
  return reached;
}

bool Simulation::go_towards(double time, const std::function<bool()>& go_on) {
  const bool chooses_threads = options_.gives_way && options_.threads > 1;
  while (state_.time < time) {
    if (chooses_threads) threads_.begin_step();
    try {
      move_on(time);
    } catch (const Diverged& failure) {
      if (!state_.scene.recovers) throw;
      go_back(failure);
    }
    if (chooses_threads) {
      threads_.end_step();
      if (threads_.now() != state_.threads) use_threads(threads_.now());
    }
    if (go_on && !go_on()) return state_.time >= time;
  }
  return true;
}

void Simulation::use_threads(int threads) {
  state_.threads = threads;
  if (state_.neighbours) state_.neighbours->use_threads(threads);
}

/// Asks for the bound of the present state. @throws InputError, Diverged where the scene's own step is above
/// it
void Simulation::set_bound() {
  bound_ = least_bound(state_, effects_);
  const auto& given = state_.scene.time_step;
  if (given && !options_.force_time_step)
    refuse_above_bound(state_, recovery_.share() * *given, bound_, steps_ > 0);
}

/// Bodies that can sleep as neighbours are listed anew.
Resting Simulation::resting() const {
  const std::optional<double> beyond = passes_.sleeps_beyond();
  if (!beyond || state_.halo || schedule_.has_moments_left()) return {};
  Resting rest = fixed_bodies(state_, *beyond);
  rest.unread = state_.unread;
  return rest;
}

std::string Simulation::time_step_set_by() const {
  if (state_.scene.time_step) return "scene";
  return bound_.name == "none" ? "output" : bound_.name;
}

Ledger Simulation::ledger() {
  form_fixed();  // the pairs of the core have lists from both sides
  return ledger_of_all(state_, effects_);
}

}  // namespace tripoint
