// SPDX-License-Identifier: BSD-3-Clause
#include "step/recovery.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "effects/solid_lab.hpp"

namespace tripoint {
namespace {

/// A cube that rings at a step beyond its frontier, and is let back from every failure.
lab::Lab ringing(double steps_of_bound) {
  lab::Lab lab = lab::elastic_lab(1.0);
  lab.add({.count = {4, 4, 4}, .phase = Phase::elastic});
  for (std::size_t i = 0; i < lab.initial.size(); ++i) lab.initial.velocity[i].x = i % 2 ? 1e-3 : -1e-3;
  lab.scene.time_step = steps_of_bound * Simulation(lab.scene, lab.initial).bound().dt;
  lab.scene.recovers = true;
  return lab;
}

double energy(Simulation& s) {
  const Ledger sum = s.ledger();
  return sum.energy.at("kinetic") + sum.energy.at("elastic") + sum.energy.at("hourglass");
}

TEST(Recovery, ARunThatFailsGoesOnWithHalfTheStepAndCountsIt) {
  const lab::Lab lab = ringing(4.0);
  Simulation s(lab.scene, lab.initial, {.force_time_step = true});
  const double before = energy(s);
  s.advance_to(2000.0);
  EXPECT_EQ(s.state().time, 2000.0);
  EXPECT_GE(s.recovery().count(), 2) << "half of four bounds is beyond the frontier too";
  EXPECT_LT(s.recovery().count(), 20);
  EXPECT_FALSE(s.recovery().last().empty());
  EXPECT_NEAR(energy(s) / before, 1.0, 0.5) << "what the guard of energy lets pass";
}

TEST(Recovery, ARunThatDoesNotFailHasTheBitsOfOneThatCannotRecover) {
  lab::Lab lab = ringing(0.9);
  Simulation with(lab.scene, lab.initial);
  with.advance_to(300.0);
  lab.scene.recovers = false;
  Simulation without(lab.scene, lab.initial);
  without.advance_to(300.0);
  EXPECT_EQ(with.recovery().count(), 0);
  EXPECT_EQ(lab::by_id(with, field::position.x), lab::by_id(without, field::position.x));
}

TEST(Recovery, ACutRunGoesBackToTheSameStates) {
  const lab::Lab lab = ringing(4.0);
  Checkpoint cut;
  Simulation whole(lab.scene, lab.initial, {.force_time_step = true});
  whole.advance_to(1000.0, [&] {
    if (whole.steps() == 70) cut = whole.checkpoint();
    return true;
  });
  ASSERT_GE(whole.recovery().count(), 1);
  Simulation continued(lab.scene, lab.initial, {.force_time_step = true}, cut);
  continued.advance_to(1000.0);
  EXPECT_EQ(continued.recovery().count(), whole.recovery().count());
  EXPECT_EQ(lab::by_id(continued, field::position.x), lab::by_id(whole, field::position.x));
}

TEST(Recovery, GivesUpWithTheFirstCauseWhereNoStepHelps) {
  Recovery r;
  Checkpoint state;
  state.real["x"] = {1.0};
  r.keep(state, 0.0);
  const Diverged cause(3, 0, "density", "density", 1.0, "particle 3 is pressed", "overlap");
  for (int k = 0; k < Recovery::most_halvings; ++k) EXPECT_NO_THROW((void)r.go_back(cause));
  EXPECT_EQ(r.share(), 1.0 / 1024.0);
  try {
    (void)r.go_back(cause);
    FAIL();
  } catch (const Diverged& e) {
    EXPECT_EQ(e.particle, 3);
    EXPECT_EQ(e.guard, "overlap");
    EXPECT_NE(std::string(e.what()).find("particle 3 is pressed"), std::string::npos);
  }
}

}  // namespace
}  // namespace tripoint
