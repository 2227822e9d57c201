// SPDX-License-Identifier: BSD-3-Clause
// The bounds that guard accuracy, not stability, from both sides: rotation and acceleration (model 8.10).
// Those of sound, viscosity, heat and elastic waves, which guard stability, have their frontiers in
// stability_map_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/fluid_lab.hpp"
#include "scene/guard_name.hpp"

namespace tripoint {
namespace {

double kinetic_energy(Simulation& s) { return s.ledger().energy.at("kinetic"); }

/// Greatest relative error of the energy of a tumbling block over 20 s at `angle` rad a step.
double spin_error(double angle) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.time_step = angle / std::sqrt(14.0);
  lab.scene.unguarded = {GuardName::time_step, GuardName::ledger};
  Simulation s(lab.scene, lab.initial, {.force_time_step = true});
  const double first = kinetic_energy(s);
  double most = 0.0;
  while (s.state().time < 20.0) {
    s.advance_to(s.state().time + *lab.scene.time_step);
    most = std::max(most, std::abs(kinetic_energy(s) / first - 1.0));
  }
  return most;
}

/// The splitting stays bounded at any angle: its bound is one of accuracy.
TEST(RotationBound,
     AtHalfARadianAStepASpinKeepsItsEnergyToAThousandthAndAtFourTimesThatItErrsTenTimesAsMuch) {
  const double at = spin_error(0.5), beyond = spin_error(2.0);
  EXPECT_LT(at, 1e-3);
  EXPECT_GT(beyond, 10.0 * at);
}

/// A given step may turn a body by half a radian; the step that is ours to choose errs 25 times less.
TEST(RotationBound, TheChosenStepKeepsTheEnergyOfASpinToAFewHundredThousandths) {
  const lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  Simulation chosen(lab.scene, lab.initial);
  EXPECT_LT(spin_error(chosen.bound().dt * std::sqrt(14.0)), 4e-5);
}

TEST(RotationBound, WithinTheBoundTheErrorFallsWithTheSquareOfTheStep) {
  EXPECT_NEAR(spin_error(0.5) / spin_error(0.25), 4.0, 0.8);
}

struct Fall {
  double error = 0.0;    ///< |energy that the steps made| over the work of weight on the way down
  bool bounded = false;  ///< the acceleration sets the step from the start on
};

constexpr double weight = 0.3;  // [m/s2], in units of c2 per spacing

/// A plate that falls half a spacing onto a floor, so heavily that its weight presses it in by a third of c2
/// per support: the acceleration sets the step, and with the speed the bounds change all the time.
lab::Lab plate_over_floor() {
  lab::Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  lab.scene.gravity = {0.0, 0.0, -weight};
  lab.add({.name = "plate", .corner = {0.0, 0.0, 1.5}, .count = {4, 4, 1}});
  lab.add({.name = "floor", .corner = {0.0, 0.0, -3.0}, .count = {4, 4, 4}, .motion = Motion::fixed});
  lab.make_periodic({true, true, false}, {0.0, 0.0, 0.0}, {4, 4, 16});
  lab.scene.unguarded = {GuardName::overlap, GuardName::time_step, GuardName::ledger};
  return lab;
}

double mechanical(Simulation& s) {
  const Ledger now = s.ledger();
  return now.energy.at("kinetic") + now.energy.at("potential") + now.energy.at("compression");
}

/// `share` of the bound of acceleration is taken as the step.
Fall heavy_fall(double share) {
  lab::Lab lab = plate_over_floor();
  const Simulation probe(lab.scene, lab.initial);
  lab.scene.time_step = share * probe.bound().dt;
  Simulation s(lab.scene, lab.initial, {.force_time_step = true});
  const double first = mechanical(s);
  Fall fall{0.0, probe.bound().name == "acceleration"};
  while (s.state().time < 30.0) {
    s.advance_to(s.state().time + *lab.scene.time_step);
    // 16 kg fall by a spacing
    fall.error = std::max(fall.error, std::abs(mechanical(s) - first) / (16.0 * weight));
  }
  return fall;
}

TEST(AccelerationBound, SetsTheStepOfAHeavyFallAndKeepsTheEnergyThatFourTimesTheStepLoses) {
  const Fall at = heavy_fall(1.0), beyond = heavy_fall(4.0);
  EXPECT_TRUE(at.bounded);
  EXPECT_LT(at.error, 0.15);  // 0.11 measured: it lands on a contact that four steps cross
  EXPECT_GT(beyond.error, 5.0 * at.error);
}

TEST(AccelerationBound, WithinItTheErrorFallsWithTheSquareOfTheStep) {
  EXPECT_NEAR(heavy_fall(0.5).error / heavy_fall(0.25).error, 4.0, 1.5);
}

/// A plate of two layers that falls onto a floor from four spacings above it, nine times as stiff as sound
/// says.
lab::Lab plate_that_falls(double contact_step) {
  lab::Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  lab.scene.values["contact_stiffness"] = 8.0;
  lab.scene.values["contact_step"] = contact_step;
  lab.add({.name = "plate", .corner = {0.0, 0.0, 5.0}, .count = {4, 4, 2}, .velocity = {0.0, 0.0, -0.05}});
  lab.add({.name = "floor", .corner = {0.0, 0.0, -3.0}, .count = {4, 4, 4}, .motion = Motion::fixed});
  lab.make_periodic({true, true, false}, {0.0, 0.0, 0.0}, {4, 4, 16});
  return lab;
}

constexpr double sound_step = 0.45 * 2.6;  // [spacings/c]

TEST(ContactBound, HoldsInEveryStepWhereNothingSaysOtherwise) {
  const lab::Lab lab = plate_that_falls(0.0);
  Simulation s(lab.scene, lab.initial);
  EXPECT_EQ(s.bound().name, "contact");
  EXPECT_NEAR(s.bound().dt, sound_step / 3.05, 1e-12);
  s.advance_to(40.0);
  EXPECT_NEAR(s.bound().dt, sound_step / 3.05, 1e-12);
}

/// The first steps are short: nothing is known yet of how densities grow. It touches at 80 dx/c, and leaves
/// at about 84.
TEST(ContactBound, WithAContactStepHoldsNearATouchAloneAndAsShortAsTheKeySays) {
  const lab::Lab lab = plate_that_falls(0.5);
  Simulation s(lab.scene, lab.initial);
  EXPECT_EQ(s.bound().name, "contact");
  EXPECT_NEAR(s.bound().dt, 0.5 * sound_step / 3.05, 1e-12);
  s.advance_to(40.0);
  EXPECT_EQ(s.bound().name, "sound");
  EXPECT_NEAR(s.bound().dt, sound_step / 1.05, 1e-12);
  bool touched = false;
  while (s.state().time < 120.0) {
    s.advance_to(s.state().time + 0.1);
    const bool pressed = s.ledger().energy.at("compression") > 1e-9;
    touched = touched || pressed;
    if (pressed) {
      EXPECT_EQ(s.bound().name, "contact") << s.state().time;
    }
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(s.bound().name, "sound") << "it flies again";
}

TEST(ContactBound, AfterAnEventHoldsUntilItIsKnownHowDensitiesGrow) {
  lab::Lab lab = plate_that_falls(0.5);
  lab.add({.name = "other", .corner = {0.0, 0.0, 10.0}, .count = {4, 4, 1}});
  Event hold;
  hold.kind = Event::Kind::hold;
  hold.time = 20.0;
  hold.bodies = {"other"};
  lab.scene.events = {hold};
  Simulation s(lab.scene, lab.initial);
  s.advance_to(19.0);
  EXPECT_EQ(s.bound().name, "sound");
  s.advance_to(20.1);
  EXPECT_EQ(s.bound().name, "contact");
  s.advance_to(21.0);
  EXPECT_EQ(s.bound().name, "sound");
}

/// As deep as where every step is short, and as fast away.
TEST(ContactBound, WithAContactStepAHitIsTheHitOfShortSteps) {
  const auto deepest = [](double contact_step) {
    const lab::Lab lab = plate_that_falls(contact_step);
    Simulation s(lab.scene, lab.initial);
    double least = 5.0;
    s.advance_to(120.0, [&] {
      least = std::min(least, s.state().bodies[field::body_centre][0].z);
      return true;
    });
    return std::pair(least, s.state().bodies[field::body_velocity][0].z);
  };
  const auto [depth, away] = deepest(1.0);
  const auto [depth_of_short, away_of_short] = deepest(0.0);
  EXPECT_NEAR(depth, depth_of_short, 0.005);
  EXPECT_NEAR(away, 0.05, 1e-3);
  EXPECT_NEAR(away_of_short, 0.05, 1e-3);
}

}  // namespace
}  // namespace tripoint
