// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assembly/all_effects.hpp"
#include "assembly/declared_view.hpp"
#include "assembly/scene_passes.hpp"
#include "core/checkpoint.hpp"
#include "scene/initial_state.hpp"
#include "step/guard.hpp"
#include "step/recovery.hpp"
#include "step/stage_clock.hpp"
#include "step/thread_choice.hpp"
#include "world/world.hpp"

namespace tripoint {

struct SimulationOptions {
  int threads = 1;
  bool gives_way = false;        ///< takes one thread while other work fills the machine; it changes no bit
  bool force_time_step = false;  ///< run with the scene's time step though it is above a bound
  double skin = 0.1;             ///< of the neighbour lists, in support radii; static scenes need none
  int lanes = 0;          ///< particles that a pair pass works on at once, 1, 4 or 8; 0 = what is fastest here. It changes no bit
  bool sums_all = false;  ///< pair passes sum also where nothing meets; it changes no bit
  std::optional<std::array<std::size_t, 3>> axis_order{};  ///< rotation by NO_SQUISH in this order instead of the better default
  Halo* halo = nullptr;                   ///< those that hold the rest of the scene; it must outlive the simulation
  StageSeconds* stage_seconds = nullptr;  ///< where to add what each stage takes; it must outlive the simulation
};

/// A scene in motion: kick, drift, kick, with the effects that it calls for.
class Simulation {
 public:
  /// @throws InputError when an effect is missing, a bound forbids the scene's time step, or the scene lacks what an effect needs
  Simulation(const Scene&, const InitialState&, const SimulationOptions& = {});

  /// Goes on from what checkpoint() gave, with the same bits as the run that it was taken from, whatever the threads.
  /// @throws InputError naming what differs when the checkpoint is of another scene or another layout of fields
  Simulation(const Scene&, const InitialState&, const SimulationOptions&, const Checkpoint&);

  /// Steps until `time` [s], which is met exactly; events on the way happen at their time, those at `time` before it returns.
  /// @param go_on asked after every step, when the state is whole: false stops there, short of `time`
  /// @return whether `time` was reached
  /// @throws Diverged with particle, field, stage and time
  bool advance_to(double time, const std::function<bool()>& go_on = {});
  /// All that a continued run needs. Taking it changes nothing.
  [[nodiscard]] Checkpoint checkpoint() const;
  /// How often a guard sent the run back, and why the last time.
  [[nodiscard]] const Recovery& recovery() const noexcept { return recovery_; }

  /// Threads of the steps that follow. They change no bit.
  void use_threads(int);
  [[nodiscard]] const World& world() const noexcept { return world_; }
  [[nodiscard]] Ledger ledger() const;  ///< of all processes that share the scene, which all call it
  [[nodiscard]] long steps() const noexcept { return steps_; }
  [[nodiscard]] double pairs() const noexcept { return pairs_; }  ///< directed pairs visited by rate passes
  [[nodiscard]] double time_step() const noexcept { return dt_; }
  [[nodiscard]] const TimeStepBound& bound() const noexcept { return bound_; }
  /// What set the step: the name of the least bound, "scene" where the scene gives it, "output" where nothing bounds it.
  [[nodiscard]] std::string time_step_set_by() const;

 private:
  struct Moment {  ///< an event's begin or end
    double time;
    std::size_t event;
    bool begins;
  };
  /// Equal steps towards one end: planned when they begin, so a continued run keeps to the plan that it was cut in.
  struct Stretch {
    double start = 0.0, end = 0.0;  ///< [s]
    long count = 0, done = 0;
    [[nodiscard]] double next_end(double dt) const {
      return done + 1 == count ? end : start + static_cast<double>(done + 1) * dt;
    }
  };
  void set_up(const Scene&, const InitialState&);
  void load(const InitialState&);
  void restore(const Checkpoint&);
  [[nodiscard]] Checkpoint state() const;
  void move_on(double time);
  void choose_threads(std::chrono::steady_clock::time_point begin);
  void check();
  void keep_good_state();
  void go_back(const Diverged&);
  [[nodiscard]] std::vector<std::string> layout() const;
  void plan_events();
  void happen_until_now();
  [[nodiscard]] bool stretch_is_over(double stop) const;
  void plan_stretch(double stop);
  [[nodiscard]] long steps_to(double time) const;
  void step(double end);
  void update_rates();
  [[nodiscard]] Resting resting() const;
  void change();
  void update_lists();
  [[nodiscard]] bool outdated() const;
  void follow_halo();
  void mark_copies();
  void pass(PassName);
  [[nodiscard]] Ledger own_ledger() const;
  [[nodiscard]] TimeStepBound next_bound() const;
  void refuse_large_step() const;
  template <class... Args>
  void run(void (Effect::*stage)(World&, Args...), Args... args) {
    for (const Active& a : effects_) {
      const DeclaredView view(world_, a);
      (a.effect.get()->*stage)(world_, args...);
    }
  }

  World world_;
  SimulationOptions options_;
  StageClock clock_{options_.stage_seconds};
  ThreadChoice threads_{options_.threads};
  long pushed_aside_ = 0;  ///< as counted after the last step
  std::vector<Active> effects_;
  Passes passes_;
  std::vector<Moment> moments_;  ///< in order of time
  std::size_t next_moment_ = 0;
  Stretch stretch_;
  double dt_ = 0.0, pairs_ = 0.0;
  TimeStepBound bound_;
  long steps_ = 0;
  GuardMemory guards_;
  Enclosure enclosure_;
  Recovery recovery_;
  std::vector<Vec3>
      shared_at_;       ///< where particles were when they were last shared out, by row; of scenes without neighbour lists
  InitialState start_;  ///< what a run that recovers is set up from again; else empty
};

}  // namespace tripoint
