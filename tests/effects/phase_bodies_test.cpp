// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/phase_lab.hpp"

namespace tripoint {
namespace {

using lab::cold;
using lab::constant;
using lab::hot;

/// With liquids from the start, which press on each other, if next to nothing.
lab::Lab wet_lab() {
  lab::Lab lab = lab::melting_lab(0.1);
  lab.scene.materials[0].stiffness = 1e-20;
  return lab;
}

void expect_kept(const Ledger& a, const Ledger& b, double size_P, double size_L) {
  EXPECT_NEAR(a.mass, b.mass, 1e-12 * a.mass);
  EXPECT_NEAR(norm(a.momentum - b.momentum), 0.0, 1e-12 * size_P);
  EXPECT_NEAR(norm(a.angular_momentum - b.angular_momentum), 0.0, 1e-12 * size_L);
  EXPECT_NEAR(lab::total_energy(a) / lab::total_energy(b), 1.0, 1e-12);
}

/// A bar of 9 x 3 x 3 that spins; its middle layer is hot and melts in the second step.
lab::Lab cut_bar() {
  lab::Lab lab = lab::melting_lab(0.1);
  lab.scene.time_step = 1e-3;
  lab.add({.name = "bar",
           .corner = {-0.4, -0.1, -0.1},
           .count = {9, 3, 3},
           .velocity = {0.3, -0.2, 0.1},
           .angular_velocity = {0.5, 1.0, 2.0},
           .temperature = [](const Vec3& r) { return std::abs(r.x) < 0.01 ? hot : cold; }});
  lab.scene.bodies[0].temperature->value = hot;  // what the scene is asked by
  return lab;
}

TEST(Splitting, ByMeltingKeepsWhatIsKept) {
  const lab::Lab lab = cut_bar();
  Simulation start(lab.scene, lab.initial);
  Simulation s = lab.run(0.01);
  EXPECT_EQ(lab::living_bodies(start), 1u);
  EXPECT_EQ(lab::living_bodies(s), 2u);
  const auto phase = lab::integers_by_id(s, field::phase), body = lab::integers_by_id(s, field::body);
  EXPECT_EQ(std::count(phase.begin(), phase.end(), 0), 9);
  EXPECT_EQ(std::count(body.begin(), body.end(), -1), 9);
  EXPECT_EQ(std::count(body.begin(), body.end(), 0), 36);
  EXPECT_EQ(std::count(body.begin(), body.end(), 1), 36);
  EXPECT_EQ(s.state().body_names[1], "bar.1");
  expect_kept(s.ledger(), start.ledger(), 81.0, 81.0);
  s.advance_to(0.5);
  expect_kept(s.ledger(), start.ledger(), 81.0, 81.0);
}

TEST(Splitting, LetsPiecesLeaveAsTheyMoved) {
  const lab::Lab lab = cut_bar();
  Simulation s(lab.scene, lab.initial);
  s.advance_to(1e-3);
  const std::vector<Vec3> whole = lab::speeds(s);
  s.advance_to(2e-3);
  ASSERT_EQ(lab::living_bodies(s), 2u);
  const Columns& t = s.state().bodies;
  // Each piece turns as the whole did, and its centre moves with v + omega x r of the whole: no force acts, v
  // and omega stay within dt^2.
  for (const std::size_t b : {0u, 1u})
    EXPECT_NEAR(norm(t[field::body_angular_velocity][b] - t[field::body_angular_velocity][0]), 0.0, 1e-12);
  const std::vector<Vec3> parted = lab::speeds(s);
  // omega^2 r dt = 2.6e-3 m/s
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(norm(parted[i] - whole[i]), 0.0, 4e-3);
}

TEST(Splitting, DownToNearlyStraightPiecesAndSingleParticlesKeepsEverything) {
  lab::Lab lab = lab::melting_lab(0.1);
  lab.scene.time_step = 1e-3;
  std::vector<Vec3> points;
  for (int k = 0; k < 9; ++k) points.push_back({0.1 * k, k % 2 ? 1e-3 : 0.0, k % 3 ? 0.0 : 5e-4});
  lab.add_points({.name = "line",
                  .velocity = {0.0, 1.0, 0.0},
                  .angular_velocity = {30.0, 0.5, 1.0},
                  .temperature = constant(cold)},
                 points, 0.1);
  lab.scene.bodies[0].temperature->value = hot;
  // Pieces of 1, 2 and 4 particles
  for (const std::size_t melts : {1u, 4u}) lab.initial.temperature[melts] = hot;
  Simulation start(lab.scene, lab.initial);
  Simulation s = lab.run(0.01);
  EXPECT_EQ(lab::living_bodies(s), 3u);
  expect_kept(s.ledger(), start.ledger(), 1.0, 1.0);
  s.advance_to(1.0);
  expect_kept(s.ledger(), start.ledger(), 1.0, 1.0);
  for (const Vec3& v : lab::speeds(s)) EXPECT_LT(norm(v), 10.0);
}

TEST(Splitting, LeavesWhatNeverMeltsTogether) {
  lab::Lab lab = lab::melting_lab(0.1);
  lab.scene.time_step = 1e-3;
  lab.add_material(1000.0, 1e-12, 1000.0);
  const std::vector<Vec3> apart{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};  // three posts that one body has
  lab.add_points({.name = "posts", .material = 1, .temperature = constant(cold)}, apart, 1.0);
  lab.add({.name = "wax", .corner = {5, 0, 0}, .count = {3, 1, 1}, .temperature = constant(hot)});
  lab.scene.bodies[0].joins = true;
  lab.scene.bodies[1].temperature->value = hot;
  const Simulation s = lab.run(0.01);
  EXPECT_EQ(lab::living_bodies(s), 1u);
  const auto body = lab::integers_by_id(s, field::body);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(body[i], 0);
}

/// Two blocks that tumble, and between them one liquid particle that is cold and freezes in the second step.
lab::Lab two_blocks_and_a_drop() {
  lab::Lab lab = wet_lab();
  lab.scene.time_step = 1e-4;
  lab.add({.name = "left",
           .corner = {-0.3, -0.1, -0.1},
           .count = {3, 3, 3},
           .velocity = {0.1, 0.2, 0.0},
           .angular_velocity = {1.0, 0.0, 2.0},
           .temperature = constant(cold)});
  lab.add({.name = "right",
           .corner = {0.1, -0.1, 0.0},
           .count = {2, 3, 4},
           .velocity = {-0.1, 0.0, 0.3},
           .angular_velocity = {0.0, -1.0, 0.5},
           .temperature = constant(cold)});
  lab.add({.name = "drop",
           .corner = {0.0, 0.0, 0.05},
           .count = {1, 1, 1},
           .phase = Phase::liquid,
           .velocity = {0.0, 0.0, -0.5},
           .temperature = constant(cold)});
  lab.scene.bodies[0].temperature->value = hot;
  return lab;
}

TEST(Merging, OfTwoBodiesByOneFreezingParticleKeepsWhatIsKept) {
  const lab::Lab lab = two_blocks_and_a_drop();
  Simulation start(lab.scene, lab.initial);
  Simulation s = lab.run(2e-3);
  EXPECT_EQ(lab::living_bodies(s), 1u);
  for (const int b : lab::integers_by_id(s, field::body)) EXPECT_EQ(b, 0);
  for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 2);
  expect_kept(s.ledger(), start.ledger(), 52.0, 52.0);
  const double kinetic = start.ledger().energy.at("kinetic") - s.ledger().energy.at("kinetic");
  const double heat = s.ledger().energy.at("thermal") - start.ledger().energy.at("thermal");
  EXPECT_GT(kinetic, 0.1);
  EXPECT_NEAR(heat, kinetic, 1e-12 * start.ledger().energy.at("thermal"));
  // and all of it in the one that froze: 1 kg of 1000 J/kg/K
  EXPECT_NEAR(lab::by_id(s, field::temperature).back() - cold, kinetic / 1000.0, 1e-9);
}

TEST(Merging, DoesNotDependOnTheOrderOfParticlesOrOnThreads) {
  lab::Lab lab = two_blocks_and_a_drop();
  // two more that freeze in the same step, one on the first drop and one on the right block
  lab.add({.name = "second",
           .corner = {0.0, 0.1, 0.05},
           .count = {1, 1, 1},
           .phase = Phase::liquid,
           .velocity = {0.2, 0.0, 0.0},
           .temperature = constant(cold)});
  lab.add({.name = "third",
           .corner = {0.3, 0.0, 0.15},
           .count = {1, 1, 1},
           .phase = Phase::liquid,
           .velocity = {0.2, 0.1, 0.0},
           .temperature = constant(cold)});
  lab.initial.temperature[3] = hot;
  Simulation s = lab.run(2e-3), threaded = lab.run(2e-3, 2);
  const std::vector<Vec3> x = lab::places(s), y = lab::places(threaded);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i], y[i]);
  EXPECT_EQ(lab::by_id(s, field::temperature), lab::by_id(threaded, field::temperature));
  EXPECT_EQ(s.ledger().energy, threaded.ledger().energy);
  for (const unsigned seed : {1u, 2u, 3u}) {
    lab::Lab other = lab;
    const std::vector<std::size_t> now = lab::shuffle(other, seed);
    const Simulation t = other.run(2e-3);
    const std::vector<Vec3> z = lab::places(t), v = lab::speeds(s), w = lab::speeds(t);
    const auto T = lab::by_id(s, field::temperature), S = lab::by_id(t, field::temperature);
    EXPECT_EQ(lab::living_bodies(t), lab::living_bodies(s));
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(norm(z[now[i]] - x[i]), 0.0, 1e-12);
      EXPECT_NEAR(norm(w[now[i]] - v[i]), 0.0, 1e-12);
      EXPECT_NEAR(S[now[i]], T[i], 1e-10);  // round-off of sums of 300 K
    }
  }
}

TEST(Merging, JoinsOnlyThroughWhatFreezes) {
  lab::Lab lab = wet_lab();
  lab.scene.time_step = 1e-3;
  lab.add({.name = "left", .corner = {-0.3, 0.0, 0.0}, .count = {3, 3, 3}, .temperature = constant(cold)});
  // They touch
  lab.add({.name = "right", .corner = {0.0, 0.0, 0.0}, .count = {3, 3, 3}, .temperature = constant(cold)});
  lab.add({.name = "far drop",
           .corner = {2.0, 0.0, 0.0},
           .count = {1, 1, 1},
           .phase = Phase::liquid,
           .temperature = constant(cold)});
  lab.scene.bodies[0].temperature->value = hot;
  const Simulation s = lab.run(0.01);
  EXPECT_EQ(lab::living_bodies(s), 3u);  // the drop is a body of one
  const auto body = lab::integers_by_id(s, field::body);
  EXPECT_EQ(body.front(), 0);
  EXPECT_EQ(body[27], 1);
  EXPECT_EQ(body.back(), 2);
  EXPECT_EQ(s.state().bodies[field::body_mass][2], 1.0);
}

TEST(Merging, ByAnEventHoldsWhereBodiesTouchAsOneOfThemMelts) {
  lab::Lab lab = lab::melting_lab(0.1);
  lab.scene.time_step = 1e-3;
  lab.add({.name = "left", .corner = {-0.3, 0.0, 0.0}, .count = {3, 3, 3}, .temperature = constant(cold)});
  lab.add({.name = "right", .corner = {0.0, 0.0, 0.0}, .count = {3, 3, 3}, .temperature = constant(cold)});
  lab.scene.bodies[0].temperature->value = hot;
  lab.initial.temperature[0] = hot;  // a corner of the left one
  Event together;
  together.kind = Event::Kind::merge;
  together.bodies = {"left", "right"};
  lab.scene.events = {together};
  const Simulation s = lab.run(0.01);
  EXPECT_EQ(lab::integers_by_id(s, field::body).front(), -1);
  EXPECT_EQ(lab::living_bodies(s), 1u);
}

TEST(Merging, NeedsMatterThatMeltsOrABodyThatJoins) {
  for (const bool joins : {false, true}) {
    lab::Lab lab = wet_lab();
    lab.scene.time_step = 1e-3;
    lab.add_material(1000.0, 1e-12, 1000.0);
    lab.add({.name = "steel", .material = 1, .count = {3, 3, 1}, .temperature = constant(cold)});
    lab.add({.name = "drop",
             .corner = {0.1, 0.1, 0.1},
             .count = {1, 1, 1},
             .phase = Phase::liquid,
             .temperature = constant(cold)});
    lab.scene.bodies[0].joins = joins;
    const Simulation s = lab.run(0.01);
    EXPECT_EQ(lab::living_bodies(s), joins ? 1u : 2u);
  }
}

TEST(Merging, WithADrivenBodyTakesItsMotionAndHeatsByTheRelativeSpeed) {
  for (const Motion motion : {Motion::fixed, Motion::prescribed}) {
    lab::Lab lab = wet_lab();
    lab.scene.time_step = 1e-3;
    lab.add({.name = "floor",
             .count = {3, 3, 1},
             .motion = motion,
             .velocity = {motion == Motion::fixed ? 0.0 : 1.0, 0.0, 0.0},
             .temperature = constant(cold)});
    lab.add({.name = "drop",
             .corner = {0.1, 0.1, 0.1},
             .count = {1, 1, 1},
             .phase = Phase::liquid,
             .velocity = {0.0, 3.0, 0.0},
             .temperature = constant(cold)});
    lab.scene.bodies[0].temperature->value = hot;
    Simulation start(lab.scene, lab.initial), s = lab.run(0.01);
    EXPECT_EQ(lab::living_bodies(s), 1u);
    const Vec3 v = s.state().bodies[field::body_velocity][0];
    EXPECT_NEAR(norm(v - Vec3{motion == Motion::fixed ? 0.0 : 1.0, 0.0, 0.0}), 0.0, 1e-15);
    const double relative = motion == Motion::fixed ? 9.0 : 10.0;  // |v - v_wall|^2
    EXPECT_NEAR(lab::by_id(s, field::temperature).back() - cold, 0.5 * relative / 1000.0, 1e-10);
    EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(start.ledger()), 1.0, 1e-12);
  }
}

TEST(Merging, OfALineBodyHandsOnTheSpinThatItCouldNotTurnWith) {
  lab::Lab lab = wet_lab();
  lab.scene.time_step = 1e-4;
  lab.add_points({.name = "line",
                  .velocity = {0.1, 0.0, 0.0},
                  .angular_velocity = {20.0, 0.0, 0.0},
                  .temperature = constant(cold)},
                 {{-0.3, 1e-3, 0.0}, {-0.2, -1e-3, 0.0}, {-0.1, 1e-3, 0.0}}, 1.0);
  lab.add({.name = "block", .corner = {0.1, -0.1, -0.1}, .count = {3, 3, 3}, .temperature = constant(cold)});
  lab.add({.name = "drop", .count = {1, 1, 1}, .phase = Phase::liquid, .temperature = constant(cold)});
  lab.scene.bodies[0].temperature->value = hot;
  Simulation start(lab.scene, lab.initial), s = lab.run(2e-3);
  EXPECT_EQ(lab::living_bodies(s), 1u);
  expect_kept(s.ledger(), start.ledger(), 1.0, 1.0);
  EXPECT_EQ(norm(s.state().accumulated.undelivered_spin), 0.0);
  EXPECT_GT(s.state().bodies[field::body_angular_velocity][0].x, 0.0);
}

TEST(Phase, GoesOnFromACheckpointBitForBit) {
  for (const double cut : {1e-4, 1e-3, 5e-3}) {
    lab::Lab lab = cut_bar();
    lab.scene.materials[0].conductivity = 5e3;
    lab.scene.materials[0].stiffness = 100.0;
    lab.scene.materials[0].latent_heat = 2e4;
    lab.add({.name = "drop",
             .corner = {0.0, 0.3, 0.0},
             .count = {2, 2, 2},
             .phase = Phase::liquid,
             .temperature = constant(cold)});
    Simulation whole(lab.scene, lab.initial), first(lab.scene, lab.initial);
    whole.advance_to(cut);
    whole.advance_to(1e-2);
    first.advance_to(cut);
    const Checkpoint kept = first.checkpoint();
    Simulation second(lab.scene, lab.initial, {}, kept);
    second.advance_to(1e-2);
    EXPECT_EQ(lab::places(second), lab::places(whole));
    EXPECT_EQ(lab::by_id(second, field::enthalpy), lab::by_id(whole, field::enthalpy));
    EXPECT_EQ(lab::by_id(second, field::liquid_fraction), lab::by_id(whole, field::liquid_fraction));
    EXPECT_EQ(lab::integers_by_id(second, field::body), lab::integers_by_id(whole, field::body));
    EXPECT_EQ(second.ledger().energy, whole.ledger().energy);
  }
}

}  // namespace
}  // namespace tripoint
