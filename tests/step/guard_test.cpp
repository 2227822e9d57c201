// SPDX-License-Identifier: BSD-3-Clause
#include "step/guard.hpp"
#include "effects/heat/fields.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "effects/fluid_lab.hpp"
#include "effects/solid_lab.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

lab::Lab warm() {
  lab::Lab lab(1e-3);
  lab.add({.count = {4, 4, 4}, .motion = Motion::fixed, .temperature = [](const Vec3& r) {
             return 300.0 + 1e4 * r.x;
           }});
  return lab;
}

TEST(Guard, NamesParticleFieldStageAndTimeOfARunThatBlowsUp) {
  lab::Lab lab = warm();
  lab.scene.time_step = 1e6;  // far above the bound: each step multiplies the error
  Simulation s(lab.scene, lab.initial, {.force_time_step = true});
  try {
    s.advance_to(1e9);
    FAIL() << "an unstable run ended as if nothing were wrong";
  } catch (const Diverged& e) {
    EXPECT_GE(e.particle, 0);
    EXPECT_EQ(e.body, 0);
    EXPECT_TRUE(e.field == "temperature" || e.field == "heat_rate") << e.field;
    EXPECT_TRUE(e.stage == "drift" || e.stage == "rates") << e.stage;
    EXPECT_GT(e.time, 0.0);
  }
}

TEST(Guard, NamesTheFieldThatASteppersWritesFirst) {
  const lab::Lab lab = warm();
  const Simulation s(lab.scene, lab.initial);
  State state{s.state()};
  state.particles[field::heat_rate][state.particles.row(9)] = std::nan("");
  state.particles[field::temperature][state.particles.row(11)] = INFINITY;
  try {
    check_finite(state);
    FAIL();
  } catch (const Diverged& e) {
    EXPECT_EQ(e.particle, 11);
    EXPECT_EQ(e.field, "temperature");
    EXPECT_EQ(e.stage, "drift");
  }
}

/// What tripped. Fails the test where nothing did.
template <class Act>
Diverged tripped(Act act) {
  try {
    act();
  } catch (const Diverged& e) {
    return e;
  }
  ADD_FAILURE() << "nothing tripped";
  return {-1, -1, "", "", 0.0, "", ""};
}

Simulation forced(const lab::Lab& lab) {
  return Simulation(lab.scene, lab.initial, {.force_time_step = true});
}

TEST(Guard, NamesTheParticleThatIsColderThanAbsoluteZero) {
  const lab::Lab lab = warm();
  State state{Simulation(lab.scene, lab.initial).state()};
  state.particles[field::temperature][state.particles.row(17)] = -1e-9;
  const Diverged e = tripped([&] { check_finite(state); });
  EXPECT_EQ(e.guard, "temperature");
  EXPECT_EQ(e.particle, 17);
}

/// A cube of 5 that each step turns inside out along x about its middle plane, but for particle 62, the
/// middle one, in which F is least: it is the only one whose neighbours on both sides all change places in
/// full.
TEST(Guard, NamesASolidThatIsTurnedInsideOut) {
  lab::Lab lab = lab::elastic_lab(1.0);
  lab.add({.corner = {-2.0, -2.0, -2.0}, .count = {5, 5, 5}, .phase = Phase::elastic});
  lab.scene.time_step = 1.0;
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    lab.initial.velocity[i].x = -1.5 * lab.initial.position[i].x;
  Simulation s = forced(lab);
  const Diverged e = tripped([&] { s.advance_to(1.0); });
  EXPECT_EQ(e.guard, "inversion");
  EXPECT_EQ(e.field, "deformation");
  EXPECT_EQ(e.body, 0);
  EXPECT_EQ(e.time, 1.0);
  EXPECT_NE(std::string(e.what()).find("det F = -0.5"), std::string::npos) << e.what();
  lab.scene.unguarded = {GuardName::inversion};
  Simulation unguarded = forced(lab);
  EXPECT_NO_THROW(unguarded.advance_to(1.0));
}

/// Two plates of three layers that meet at ten times their speed of sound pass through each other.
TEST(Guard, NamesBodiesThatOverlapByMoreThanASpacing) {
  lab::Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  lab.add({.name = "left", .count = {3, 4, 4}, .velocity = {10.0, 0.0, 0.0}});
  lab.add({.name = "right", .corner = {5.0, 0.0, 0.0}, .count = {3, 4, 4}});
  Simulation s(lab.scene, lab.initial);
  const Diverged e = tripped([&] { s.advance_to(1.0); });
  EXPECT_EQ(e.guard, "overlap");
  EXPECT_EQ(e.field, "density");
  EXPECT_NE(std::string(e.what()).find(e.body == 0 ? "\"left\"" : "\"right\""), std::string::npos)
      << e.what();
  EXPECT_GT(e.time, 0.2) << "their faces touch at 0.2 s";
  EXPECT_LT(e.time, 0.45) << "coincide by one layer at 0.3 s, and steps are 0.1 s";
}

TEST(Guard, BodiesThatTouchOverlapByNothing) {
  lab::Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  lab.add({.name = "left", .count = {3, 4, 4}, .velocity = {0.05, 0.0, 0.0}});
  lab.add({.name = "right", .corner = {3.0, 0.0, 0.0}, .count = {3, 4, 4}});
  EXPECT_NO_THROW(static_cast<void>(lab.run(10.0)));
}

TEST(Guard, NamesTheParticleThatLeavesTheDomainAndLetsWallsStandOutsideIt) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, 1.0);
  lab.add({.name = "wall", .corner = {-1.0, 0.0, 0.0}, .count = {1, 3, 3}, .motion = Motion::fixed});
  lab.add({.name = "drop",
           .corner = {0.5, 0.5, 0.5},
           .count = {3, 1, 1},
           .phase = Phase::liquid,
           .velocity = {0.1, 0.0, 0.0}});
  lab.make_periodic({false, false, false}, {0.0, 0.0, 0.0}, {10, 10, 10});
  lab.scene.min = Vec3{0.0, 0.0, 0.0};
  lab.scene.max = Vec3{1.0, 1.0, 1.0};
  Simulation s(lab.scene, lab.initial);
  EXPECT_NO_THROW(s.advance_to(3.0));
  const Diverged e = tripped([&] { s.advance_to(5.0); });
  EXPECT_EQ(e.guard, "escape");
  EXPECT_EQ(e.particle, 11) << "the front one";
  EXPECT_NEAR(e.time, 4.0, 0.1) << "0.4 m to the one spacing beyond the face, at 0.1 m/s";
}

TEST(Guard, NamesEnergyThatTheSchemeMakes) {
  lab::Lab lab = lab::elastic_lab(1.0);
  lab.scene.materials[0].conductivity = lab.scene.materials[0].heat_capacity = 1.0;
  lab.add({.count = {4, 4, 4}, .phase = Phase::elastic, .temperature = [](const Vec3&) { return 300.0; }});
  for (std::size_t i = 0; i < lab.initial.size(); ++i) lab.initial.velocity[i].x = i % 2 ? 1e-3 : -1e-3;
  lab.initial.velocity[21].y = 0.01;
  Simulation s(lab.scene, lab.initial);
  Ledger ledger = s.ledger();
  const double kinetic = ledger.energy.at("kinetic"), dt = s.bound().dt;
  GuardMemory memory;
  ledger.energy["time_integration"] = -0.4 * kinetic;
  EXPECT_NO_THROW(
      check_energy(s.state(), ledger, s.state().accumulated[account::start_potential], dt, memory));
  EXPECT_DOUBLE_EQ(memory.turned_over, kinetic);
  ledger.energy["time_integration"] = 0.6 * kinetic;
  const Diverged e = tripped(
      [&] { check_energy(s.state(), ledger, s.state().accumulated[account::start_potential], dt, memory); });
  EXPECT_EQ(e.guard, "ledger");
  EXPECT_EQ(e.particle, 21) << "the fastest";
  ledger.energy["thermal"] = 1e9;
  EXPECT_THROW(check_energy(s.state(), ledger, s.state().accumulated[account::start_potential], dt, memory),
               Diverged)
      << "heat hides no energy of motion";
}

/// A column between fixed walls whose ledger says that forces have made what moves.
TEST(Guard, CountsWhatForcesMakeAsMadeByTheScheme) {
  lab::Lab lab = lab::column(4, 4, 5.0, 1000.0, 10.0);
  lab.scene.modes[term::pressure] = Mode::paper;
  Simulation s(lab.scene, lab.initial);
  Ledger ledger = s.ledger();
  ASSERT_EQ(ledger.energy.count("viscous"), 1u);
  GuardMemory memory;
  const auto check = [&] {
    check_energy(s.state(), ledger, s.state().accumulated[account::start_potential], s.bound().dt, memory);
  };
  ledger.energy["kinetic"] = 100.0;
  ledger.energy["viscous"] = -40.0;
  EXPECT_NO_THROW(check());
  ledger.energy["viscous"] = -60.0;
  const Diverged viscous = tripped(check);
  EXPECT_EQ(viscous.guard, "ledger");
  EXPECT_NE(std::string(viscous.what()).find("made 60 J by viscous forces"), std::string::npos)
      << viscous.what();
  ledger.energy["viscous"] = 10.0;
  ledger.energy["pressure_work"] = -90.0;
  EXPECT_NO_THROW(check()) << "bodies that move give energy to the printed pressure, and take it again";
  memory.still = true;
  const Diverged printed = tripped(check);
  EXPECT_NE(std::string(printed.what()).find("made 80 J by the printed pressure"), std::string::npos)
      << printed.what();
  EXPECT_NE(std::string(printed.what()).find("the corrected forms"), std::string::npos) << printed.what();
  ledger.energy["viscous"] = 50.0;
  EXPECT_NO_THROW(check()) << "viscosity has taken half of it again";
}

TEST(Guard, NamesTheBoundThatLetsTheStepCollapse) {
  const lab::Lab lab = warm();
  const Simulation s(lab.scene, lab.initial);
  GuardMemory memory;
  EXPECT_NO_THROW(check_step(s.state(), {1.0, "sound"}, memory));
  EXPECT_NO_THROW(check_step(s.state(), {1e-4, "sound"}, memory));
  const Diverged e = tripped([&] { check_step(s.state(), {1e-6, "bonds"}, memory); });
  EXPECT_EQ(e.guard, "time_step");
  EXPECT_NE(std::string(e.what()).find("bonds"), std::string::npos);
}

TEST(Guard, RefusesAChosenStepThatComesToLieAboveABound) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, 1.0);
  lab.scene.gravity = {0.0, 0.0, -10.0};
  lab.add({.name = "drop", .count = {2, 2, 2}, .phase = Phase::liquid});
  lab.scene.time_step = 0.02;  // sound: 0.45 h/(c + |v|) = 0.117 s at rest, 0.02 s at 4.8 m/s
  Simulation s(lab.scene, lab.initial);
  const Diverged e = tripped([&] { s.advance_to(2.0); });
  EXPECT_EQ(e.guard, "time_step");
  EXPECT_NE(std::string(e.what()).find("sound"), std::string::npos) << e.what();
  EXPECT_NEAR(e.time, 0.48, 0.03);
  EXPECT_NO_THROW(forced(lab).advance_to(2.0));
}

}  // namespace
}  // namespace tripoint
