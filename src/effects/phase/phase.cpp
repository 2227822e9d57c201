// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/phase.hpp"

#include <utility>

#include "effects/phase/softening.hpp"
#include "effects/phase/transition.hpp"
#include "scene/shared_terms.hpp"
#include "solids/solid_particles.hpp"
#include "state/body_table.hpp"

namespace tripoint::phase {
namespace {

class PhaseChange : public Effect {
 public:
  explicit PhaseChange(const Scene& scene) : softens_(any_softens(scene)) {}
  void load(State& state, const InitialState&) override {
    if (softens_) load_stiffness(state);
  }
  void drift(State&, double dt) override { drifted_ = dt; }
  [[nodiscard]] bool wants_change(State&) override;
  void change(State&) override;
  void renumber(State&) override { found_.reset(); }
  void settle(State&) override;
  void happen(State&, const Happening&) override;
  /// The entry is told also where nothing stands on it yet.
  void add_to(const State& state, Ledger& ledger) const override {
    if (!state.forces.empty()) ledger.energy["phase_work"] += 0.0;
  }

 private:
  bool softens_;
  double drifted_ = 0.0;                    ///< since the last forces, within a step [s]
  double back_ = 0.0;                       ///< half of that, when events were last looked for [s]
  std::optional<Events> found_;             ///< by wants_change(), where ids are still the same
  std::optional<ReleasedEnergy> released_;  ///< of the step that is being taken
};

/// Strain energy of a particle's bonds half a drift ago [J]; 0 where no body can deform. The kick before a
/// drift has the forces of before the change, the kick after it the new ones. So the change lets go the
/// difference of energies half way, to second order in the step.
ReleasedEnergy::Energy energy_of(const State& state, double back) {
  if (!state.particles.has(field::shape_rank.name)) return [](std::uint32_t) { return 0.0; };
  return [&state, back, forms = solid::ElasticForms(state.scene)](std::uint32_t id) {
    return solid::deformation_energy(state, forms, id, back).total();
  };
}

bool PhaseChange::wants_change(State& state) {
  released_.reset();
  back_ = 0.5 * std::exchange(drifted_, 0.0);
  if (state.neighbours->rebuilds() == 0) {  // the run begins
    state.neighbours->update(state.particles, state.time);
    connect_rigid_bodies(state);
  }
  if (softens_) follow_stiffness(state);
  found_ = events_of(state);
  return !found_->empty();
}

void PhaseChange::change(State& state) {
  if (!found_) found_ = events_of(state);
  const Events events = *std::exchange(found_, {});
  if (events.empty()) return;
  state.neighbours->update(state.particles, state.time);
  // As they are before the change
  if (!state.neighbours->marked()) state.neighbours->mark_own(state.particles, state.own);
  released_.emplace(energy_of(state, back_));
  carry_out(state, events, *released_);
}

void PhaseChange::settle(State& state) {
  if (released_) released_->settle(state);
}

/// Bodies that an event has united hold together by bonds where they touch.
void PhaseChange::happen(State& state, const Happening& now) {
  if (now.event.kind != Event::Kind::merge || !now.begins) return;
  state.neighbours->update(state.particles, state.time);
  connect_rigid_bodies(state);
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"phase",
               scene.mode_of(term::phase),
               {field::liquid_fraction},
               fields::joined({fields::position(),
                               fields::velocity(),
                               fields::grouping(),
                               {field::mass, field::temperature, field::heat_capacity, field::held}})};
  s.reads_if_there = fields::joined({fields::image(),
                                     {field::driven, field::enthalpy},
                                     fields::deformation(),
                                     fields::shapes(),
                                     fields::deformation_if_there(),
                                     fields::shapes_if_there()});
  s.changes = true;
  if (any_softens(scene)) s.owns.emplace_back(field::stiffness_share);
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<PhaseChange>(scene); }

}  // namespace tripoint::phase
