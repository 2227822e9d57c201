// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pairs/pair_work.hpp"
#include "scene/initial_state.hpp"
#include "state/field_groups.hpp"
#include "state/state.hpp"

/// An effect: a part of physics that a scene calls for. Effects do not know each other; they meet in fields.
namespace tripoint {

/// Columns of which a stage forms the values of own particles alone, as sums over pairs and bonds are. The
/// step hands them to the ghosts that other processes have, when the effect has run.
struct OwnSums {
  std::vector<const Field<double>*> densities{}, state{}, bonds{};
};

/// The columns that an effect owns and those that it reads of others. The effect is given no other column
/// (declared_view.hpp).
struct EffectSpec {
  std::string_view name;
  Mode mode = Mode::corrected;
  FieldList owns;  ///< columns that exist because of it
  /// Of others, that it reads or sets; each has an owner in the scene
  FieldList reads;
  std::vector<Force> forces{};  ///< that it makes
  /// Energy accounts that it writes beside those of its forces; common ones need no word
  std::vector<EnergyAccount> accounts{};
  /// Accounts of the energy that its numerical terms take on purpose
  std::vector<EnergyAccount> numerical{};
  std::vector<Guarded> guards{};  ///< of its columns those that are looked at after every step
  /// Of its columns those of whole numbers that stand for something
  std::vector<Bounded> bounded{};
  /// Of its columns those that formulas divide by, and densities
  std::vector<Field<double>> positive{};
  /// Of its entries of the ledger, how the guard of energy takes them
  std::vector<GuardedEntry> guarded_entries{};
  /// Its columns of bodies that are sums over particles. Where several processes share a scene, each sums its
  /// own part.
  std::vector<Field<double>> body_sums{};
  OwnSums own_sums{};
  std::vector<StepNumber> step_numbers{};  ///< that it keeps from step to step beside its columns
  FieldList reads_if_there{};              ///< of others, where the scene has them
  bool sums_forces = false;                ///< it reads State::forces of all effects
  bool changes = false;                    ///< change() may be called of it: wants_change() is asked
  /// It ignores sleeping particles, and needs the forces on fixed ones only in form_fixed()
  bool skips_sleeping = false;
};

/// Greatest stable step of an effect, and what sets it.
struct TimeStepBound {
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  std::string name = "none";
};
inline void tighten(TimeStepBound& bound, double dt, std::string_view name) {
  if (dt < bound.dt) bound = {dt, std::string(name)};
}

/// Share of sqrt(h/a) that a step under an acceleration a takes [1]: a choice that guards accuracy, not
/// stability. AccelerationBound measures the energy that four times such a step loses
/// (tests/step/bounds_test.cpp).
inline constexpr double courant_of_acceleration = 0.25;

/// Greatest step under an acceleration (model 8.10) [s]. @param support radius h of the support [m] @param
/// acceleration its greatest size, above 0 [m/s2]
[[nodiscard]] inline double acceleration_step(double support, double acceleration) noexcept {
  return courant_of_acceleration * std::sqrt(support / acceleration);
}

/// An event of the scene as it begins or, where it lasts, ends.
struct Happening {
  const Event& event;
  bool begins;
};

/// An effect keeps nothing from step to step in members of its own. State that the next step needs is a
/// column or a step number, where a checkpoint finds it.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Fills the columns that the effect owns. @throws InputError when the scene lacks what it needs
  virtual void load(State&, const InitialState&) {}
  /// Velocities gain dt times the present forces over the masses. @param dt half a step [s]
  virtual void kick(State&, double /*dt*/) {}
  /// Places move by dt times the velocities. @param dt length of the step [s]
  virtual void drift(State&, double /*dt*/) {}
  /// Whether the pass of density holds the sums that it may hold (State::holds_sums). Called before it.
  virtual void decide_sums(State&) {}
  /// The pass has set the columns to which the terms of the effect add to 0 in these rows. Sums that begin
  /// with another value get it here.
  virtual void start_sums(State&, PassName, const Rows&) {}
  /// Adds to the sums of the pass of density, and takes densities from them. Called where places are new,
  /// before all states. @param rows whose values a step reads
  virtual void densities(State&, const Rows& /*rows*/) {}
  /// Sets the quantities that follow from the densities at the present places: pressures, temperatures,
  /// strains.
  virtual void state(State&, const Rows& /*rows*/) {}
  /// Sets the quantities that follow from the states of all effects.
  virtual void after_states(State&, const Rows& /*rows*/) {}
  /// Forces of bonds and others that no pass sums, after all states of the present time. @param rows whose
  /// forces are formed now
  virtual void bonds(State&, const Rows& /*rows*/) {}
  /// Sets the values of fixed particles that no step reads, except the sums of the passes. Called after their
  /// density.
  virtual void form_fixed(State&, const Rows& /*rows*/) {}
  /// Whether change() has anything to decide. Changes that depend on one particle's state alone are made here
  /// first. Each process that shares the scene is asked, about its own particles and about the known values
  /// of ghosts.
  [[nodiscard]] virtual bool wants_change(State&) { return false; }
  /// Decides what melts, freezes or breaks, changes bonds, phases and bodies, and tells it in State::change.
  /// It is called where wants_change() said so, in any of the processes that share the scene; each of them
  /// then holds all of it.
  virtual void change(State&) {}
  /// Particles are about to leave the scene: accumulates as outflow the energy that the effect counts of
  /// them. @param rows of these particles, in order of id
  virtual void lose(State&, std::span<const std::size_t> /*rows*/) {}
  /// Follows State::change in the columns that the effect owns.
  virtual void adopt(State&) {}
  /// Settles what State::change cost or set free, when all have adopted it.
  virtual void settle(State&) {}
  /// The second stage of two-stage schemes, with rates at the predicted state. @param dt length of the step
  /// [s] @return whether rates must be computed again (PassName::again)
  virtual bool correct(State&, double /*dt*/) { return false; }
  virtual void happen(State&, const Happening&) {}
  /// Rows and ids stand for other particles (State::halo): data that the effect keeps by row or id are void.
  virtual void renumber(State&) {}
  /// Looks, after every step, for a state that the effect's equations do not hold for. @throws Diverged
  virtual void check(const State&) const {}
  [[nodiscard]] virtual TimeStepBound max_dt(const State&) const { return {}; }
  virtual void add_to(const State&, Ledger&) const {}
  /// Asked once, before the first step.
  [[nodiscard]] virtual PairWork pair_work(const Scene&) const { return {}; }
};

}  // namespace tripoint
