// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "effects/lab.hpp"

namespace tripoint {
namespace {

constexpr double round_off = 1e-13;

/// A cube and a bar of particles of 1/64 kg that meet at an angle [notes of this test: E1/E0 = 0.093563].
lab::Lab cube_and_bar() {
  lab::Lab lab(0.1);
  lab.scene.materials[0].density = 1.0 / 64.0 / 1e-3;
  lab.scene.time_step = 1e-3;
  lab.add({.name = "cube",
           .corner = {-0.15, -0.15, -0.15},
           .count = {4, 4, 4},
           .velocity = {1.0, 0.0, 0.0},
           .angular_velocity = {1.0, 2.0, 0.0}});
  lab.add({.name = "bar",
           .corner = {0.35, -0.05, -0.2},
           .count = {3, 3, 5},
           .velocity = {-1.0, 0.2, 0.0},
           .angular_velocity = {0.0, -1.0, 3.0}});
  return lab;
}
Event event(Event::Kind kind, double time, std::vector<std::string> bodies) {
  Event e;
  e.kind = kind;
  e.time = time;
  e.bodies = std::move(bodies);
  return e;
}
void expect_kept(const Ledger& a, const Ledger& b) {
  EXPECT_NEAR(a.mass, b.mass, round_off);
  EXPECT_NEAR(norm(a.momentum - b.momentum), 0.0, round_off);
  EXPECT_NEAR(norm(a.angular_momentum - b.angular_momentum), 0.0, round_off);
}

TEST(Merge, KeepsMassMomentumAndAngularMomentumAndAccumulatesTheRest) {
  lab::Lab lab = cube_and_bar();
  Simulation apart(lab.scene, lab.initial);
  lab.scene.events = {event(Event::Kind::merge, 0.0, {"cube", "bar"})};
  Simulation joined(lab.scene, lab.initial);
  const Ledger before = apart.ledger(), after = joined.ledger();
  expect_kept(before, after);
  // An implementation apart, six digits
  EXPECT_NEAR(after.energy.at("kinetic") / before.energy.at("kinetic"), 0.093563, 1e-6);
  EXPECT_NEAR(after.energy.at("kinetic") + after.energy.at("merging"), before.energy.at("kinetic"),
              round_off);
  EXPECT_FALSE(joined.state().bodies[field::body_alive][1]);
  for (const int b : joined.state().particles[field::body]) EXPECT_EQ(b, 0);
}

TEST(Merge, KeepsTheOrientationOfTheBodyThatStays) {
  lab::Lab lab = cube_and_bar();
  lab.scene.events = {event(Event::Kind::merge, 0.1, {"cube", "bar"})};
  lab::Lab never = cube_and_bar();
  Simulation merged = lab.run(0.1), apart = never.run(0.1);
  EXPECT_EQ(merged.state().bodies[field::body_orientation][0],
            apart.state().bodies[field::body_orientation][0]);
  const auto x = positions(merged.state().particles), y = positions(apart.state().particles);
  for (std::size_t i = 0; i < lab.initial.size(); ++i) EXPECT_NEAR(norm(x.at(i) - y.at(i)), 0.0, round_off);
  Simulation later = lab.run(0.5);
  expect_kept(later.ledger(), apart.ledger());
}

TEST(Merge, WithAFixedBodyKeepsItFixed) {
  lab::Lab lab = cube_and_bar();
  lab.scene.bodies[0].motion = Motion::fixed;
  lab.scene.events = {event(Event::Kind::merge, 0.1, {"cube", "bar"})};
  Simulation s = lab.run(0.3);
  EXPECT_EQ(norm(s.state().bodies[field::body_velocity][0]), 0.0);
  EXPECT_GT(s.ledger().energy.at("merging"), 0.0);
  lab.scene.events = {event(Event::Kind::merge, 0.1, {"bar", "cube"})};
  EXPECT_THROW((void)lab.run(0.3), InputError);
}

TEST(Merge, WithAPrescribedBodyMovesOnWithIt) {
  lab::Lab lab = cube_and_bar();
  lab.scene.bodies[0].motion = Motion::prescribed;
  lab.scene.events = {event(Event::Kind::merge, 0.1, {"cube", "bar"})};
  const Simulation s = lab.run(0.3), alone = [&] {
    lab.scene.events.clear();
    return lab.run(0.3);
  }();
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(norm(positions(s.state().particles).at(i) - positions(alone.state().particles).at(i)), 0.0,
                round_off);
    EXPECT_NEAR(norm(velocities(s.state().particles).at(i) - velocities(alone.state().particles).at(i)), 0.0,
                round_off);
  }
  EXPECT_NEAR(s.state().bodies[field::body_mass][0], 109.0 / 64.0, round_off);
}

lab::Lab spinning_bar() {
  lab::Lab lab(0.1);
  lab.scene.time_step = 1e-3;
  lab.add({.name = "whole",
           .corner = {-0.45, -0.15, -0.05},
           .count = {10, 4, 2},
           .velocity = {0.3, -0.2, 0.1},
           .angular_velocity = {0.5, 1.0, 2.0}});
  return lab;
}
Event cut(double time) {
  Event e = event(Event::Kind::split, time, {"whole"});
  e.name = "piece";
  e.region.emplace();
  e.region->kind = Shape::Kind::half_space;
  e.region->point = {0.015, 0.0, 0.0};
  e.region->normal = {-1.0, 0.0, 0.0};
  return e;
}

TEST(Split, KeepsMassMomentumAngularMomentumAndEnergy) {
  lab::Lab lab = spinning_bar();
  Simulation whole(lab.scene, lab.initial);
  lab.scene.events = {cut(0.0)};
  Simulation parted(lab.scene, lab.initial);
  const Ledger before = whole.ledger(), after = parted.ledger();
  expect_kept(before, after);
  EXPECT_NEAR(after.energy.at("kinetic") / before.energy.at("kinetic"), 1.0, round_off);
  ASSERT_EQ(parted.state().bodies.size(), 2u);
  EXPECT_EQ(parted.state().bodies[field::body_orientation][1], Quaternion{});
  EXPECT_EQ(parted.state().body_names[1], "piece");
}

TEST(Split, LetsEveryParticleLeaveWithTheVelocityThatItHad) {
  lab::Lab lab = spinning_bar();
  const Simulation whole = lab.run(0.05);
  lab.scene.events = {cut(0.05)};
  const Simulation parted = lab.run(0.05);
  for (std::size_t i = 0; i < lab.initial.size(); ++i) {
    EXPECT_NEAR(norm(velocities(parted.state().particles).at(i) - velocities(whole.state().particles).at(i)),
                0.0, round_off);
  }
}

TEST(Split, IsUndoneByAMerge) {
  lab::Lab lab = spinning_bar();
  Simulation whole(lab.scene, lab.initial);
  lab.scene.events = {cut(0.0), event(Event::Kind::merge, 0.0, {"whole", "piece"})};
  Simulation again(lab.scene, lab.initial);
  expect_kept(whole.ledger(), again.ledger());
  EXPECT_NEAR(again.ledger().energy.at("merging"), 0.0, round_off);
  EXPECT_NEAR(norm(again.state().bodies[field::body_angular_velocity][0] - Vec3{0.5, 1.0, 2.0}), 0.0,
              round_off);
}

TEST(Split, OfATruncatedLineStaysFiniteAndAccumulatesTheSpinThatItCannotHandOn) {
  lab::Lab lab(0.1);
  lab.scene.time_step = 1e-3;
  std::vector<Vec3> points;
  for (int k = 0; k < 6; ++k) points.push_back({0.1 * k, k % 2 ? 1e-3 : 0.0, 0.0});
  lab.add_points({.name = "whole", .angular_velocity = {50.0, 0.0, 1.0}}, points, 0.1);
  Simulation whole(lab.scene, lab.initial);
  Event e = cut(0.0);
  e.region->point = {0.25, 0.0, 0.0};
  lab.scene.events = {e};
  Simulation parted(lab.scene, lab.initial);
  expect_kept(whole.ledger(), parted.ledger());
  EXPECT_GT(norm(parted.state().accumulated.undelivered_spin), 0.0);
  parted.advance_to(1.0);
  expect_kept(whole.ledger(), parted.ledger());
}

TEST(Split, DownToSingleParticlesKeepsEverything) {
  lab::Lab lab(0.1);
  lab.scene.time_step = 1e-3;
  lab.add({.name = "whole",
           .count = {3, 1, 1},
           .velocity = {1.0, 0.0, 0.0},
           .angular_velocity = {0.0, 0.0, 2.0}});
  Simulation whole(lab.scene, lab.initial);
  Event first = cut(0.0), second = cut(0.0);
  first.region->point = {0.05, 0.0, 0.0};
  second.region->point = {0.15, 0.0, 0.0};
  second.bodies = {"piece"};
  second.name = "last";
  lab.scene.events = {first, second};
  Simulation parted(lab.scene, lab.initial);
  EXPECT_EQ(parted.state().bodies.size(), 3u);
  expect_kept(whole.ledger(), parted.ledger());
  parted.advance_to(0.5);
  expect_kept(whole.ledger(), parted.ledger());
}

TEST(Split, OfNothingSaysSo) {
  lab::Lab lab = spinning_bar();
  Event e = cut(0.0);
  e.region->point = {100.0, 0.0, 0.0};
  lab.scene.events = {e};
  EXPECT_THROW(Simulation(lab.scene, lab.initial), InputError);
}

}  // namespace
}  // namespace tripoint
