// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/phase.hpp"

#include <utility>

#include "effects/phase/softening.hpp"
#include "effects/phase/transition.hpp"
#include "scene/shared_terms.hpp"
#include "solids/solid_particles.hpp"
#include "world/body_table.hpp"

namespace tripoint::phase {
namespace {

class PhaseChange : public Effect {
 public:
  explicit PhaseChange(const Scene& scene) : softens_(any_softens(scene)) {}
  void load(World& world, const InitialState&) override {
    if (softens_) load_stiffness(world);
  }
  void drift(World&, double dt) override { drifted_ = dt; }
  [[nodiscard]] bool wants_change(World&) override;
  void change(World&) override;
  void renumber(World&) override { found_.reset(); }
  void settle(World&) override;
  void happen(World&, const Happening&) override;
  /// The entry is told also where nothing stands on it yet.
  void add_to(const World& world, Ledger& ledger) const override {
    if (!world.forces.empty()) ledger.energy["phase_work"] += 0.0;
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
ReleasedEnergy::Energy energy_of(const World& world, double back) {
  if (!world.particles.has(field::shape_rank.name)) return [](std::uint32_t) { return 0.0; };
  return [&world, back, forms = solid::ElasticForms(world.scene)](std::uint32_t id) {
    return solid::deformation_energy(world, forms, id, back).total();
  };
}

bool PhaseChange::wants_change(World& world) {
  released_.reset();
  back_ = 0.5 * std::exchange(drifted_, 0.0);
  if (world.neighbours->rebuilds() == 0) {  // the run begins
    world.neighbours->update(world.particles, world.time);
    connect_rigid_bodies(world);
  }
  if (softens_) follow_stiffness(world);
  found_ = events_of(world);
  return !found_->empty();
}

void PhaseChange::change(World& world) {
  if (!found_) found_ = events_of(world);
  const Events events = *std::exchange(found_, {});
  if (events.empty()) return;
  world.neighbours->update(world.particles, world.time);
  // As they are before the change
  if (!world.neighbours->marked()) world.neighbours->mark_own(world.particles, world.own);
  released_.emplace(energy_of(world, back_));
  carry_out(world, events, *released_);
}

void PhaseChange::settle(World& world) {
  if (released_) released_->settle(world);
}

/// Bodies that an event has united hold together by bonds where they touch.
void PhaseChange::happen(World& world, const Happening& now) {
  if (now.event.kind != Event::Kind::merge || !now.begins) return;
  world.neighbours->update(world.particles, world.time);
  connect_rigid_bodies(world);
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
