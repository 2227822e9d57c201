// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assembly/all_effects.hpp"
#include "core/checkpoint.hpp"
#include "pairs/scene_passes.hpp"
#include "scene/initial_state.hpp"
#include "state/state.hpp"
#include "step/guard.hpp"
#include "step/recovery.hpp"
#include "step/schedule.hpp"
#include "step/sharing.hpp"
#include "step/stage_clock.hpp"
#include "step/thread_choice.hpp"

namespace tripoint {

struct SimulationOptions {
  int threads = 1;
  bool gives_way = false;        ///< takes one thread while other work fills the machine; it changes no bit
  bool force_time_step = false;  ///< run with the scene's time step though it is above a bound
  double skin = 0.1;             ///< of the neighbour lists, in support radii; static scenes need none
  /// Particles that a pair pass works on at once, 1, 4 or 8; 0 = the fastest here. It changes no bit
  int lanes = 0;
  bool sums_all = false;  ///< pair passes sum also where nothing meets; it changes no bit
  /// Rotation by NO_SQUISH in this order instead of the better default
  std::optional<std::array<std::size_t, 3>> axis_order{};
  /// Those that hold the rest of the scene; it must outlive the simulation
  Halo* halo = nullptr;
  /// Where to add the time of each stage; it must outlive the simulation
  StageSeconds* stage_seconds = nullptr;
};

/// A scene in motion: kick, drift, kick, with the effects that it calls for. The step itself is in step.cpp.
class Simulation {
 public:
  /// @throws InputError when an effect is missing, a bound forbids the scene's time step, or the scene lacks
  /// what an effect needs
  Simulation(const Scene&, const InitialState&, const SimulationOptions& = {});

  /// Goes on from what checkpoint() gave, with the same bits as the run that it was taken from, whatever the
  /// threads.
  /// @throws InputError naming what differs when the checkpoint is of another scene or another layout of
  /// fields
  Simulation(const Scene&, const InitialState&, const SimulationOptions&, const Checkpoint&);

  /// Steps until `time` [s], which is met exactly; events on the way happen at their time, those at `time`
  /// before it returns.
  /// @param go_on asked after every step, when the state is whole: false stops there, short of `time`
  /// @return whether `time` was reached
  /// @throws Diverged with particle, field, stage and time
  bool advance_to(double time, const std::function<bool()>& go_on = {});
  /// All that a continued run needs. Asking computes what no step reads (form_fixed), and changes no bit of
  /// the steps that follow.
  [[nodiscard]] Checkpoint checkpoint();
  /// How often a guard sent the run back, and why the last time.
  [[nodiscard]] const Recovery& recovery() const noexcept { return recovery_; }

  /// Threads of the steps that follow. They change no bit.
  void use_threads(int);
  [[nodiscard]] const State& state() const noexcept { return state_; }
  /// Of all processes that share the scene, which all call it. Asking computes: pair passes over what no step
  /// reads (form_fixed), once a state, then sums over all particles and bonds. It changes no bit of the steps
  /// that follow.
  [[nodiscard]] Ledger ledger();
  /// Brings bodies that only other processes keep up to date. All processes that share the scene call it.
  void complete_bodies() { state_.body_owners.complete(state_); }
  [[nodiscard]] long steps() const noexcept { return steps_; }
  [[nodiscard]] double pairs() const noexcept { return pairs_; }  ///< directed pairs visited by rate passes
  [[nodiscard]] double time_step() const noexcept { return dt_; }
  [[nodiscard]] const TimeStepBound& bound() const noexcept { return bound_; }
  /// Name of the bound that set the step: that of the least bound, "scene" where the scene gives it, "output"
  /// where nothing bounds it.
  [[nodiscard]] std::string time_step_set_by() const;

 private:
  // step.cpp
  void move_on(double time);
  void choose_step(double stop);
  void step(double end);
  void form_rates();
  void form_fixed();
  void change();
  void let_go();
  [[nodiscard]] bool wants_change(const Active&);
  void find_neighbours();
  void correct();
  void check();
  void check_particles();
  template <class... How>
  void each_effect(Stage, How...);
  void kick(double dt);
  void drift(double dt);
  void form_states();
  void sum_bonds();
  void pass(PassName);
  void start_sums(PassName);
  void sum(PassName);
  [[nodiscard]] bool leaves_out_first_kick() const;
  void happen_until_now();
  // set_up.cpp
  void set_up(const Scene&, const InitialState&);
  void load(const InitialState&);
  // going_back.cpp
  void keep_good_state();
  void go_back(const Diverged&);
  // checkpoint.cpp
  [[nodiscard]] std::vector<std::string> layout() const;
  [[nodiscard]] Checkpoint whole_checkpoint();
  [[nodiscard]] Checkpoint checkpoint_of(const State& whole) const;
  void restore(const Checkpoint&);
  // simulation.cpp
  bool go_towards(double time, const std::function<bool()>& go_on);
  void set_bound();
  [[nodiscard]] Resting resting() const;

  State state_;
  SimulationOptions options_;
  ThreadChoice threads_{options_.threads};
  std::vector<Active> effects_;
  Passes passes_;
  Sharing sharing_{options_.skin, options_.halo};
  Schedule schedule_;
  double dt_ = 0.0;      ///< length of the steps of this stretch [s]
  double pairs_ = 0.0;   ///< directed pairs that rate passes have visited
  TimeStepBound bound_;  ///< as last asked for
  long steps_ = 0;
  GuardMemory guards_;
  Enclosure enclosure_;
  Recovery recovery_;
  InitialState start_;  ///< state that a run that recovers is set up from again; else empty
};

}  // namespace tripoint
