// SPDX-License-Identifier: BSD-3-Clause
#include "step/simulation.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/machine.hpp"
#include "effects/lab.hpp"

namespace tripoint {
namespace {

/// FNV-1a over the bits of every column by id, and of the bodies.
std::uint64_t hash_of(const Simulation& s) {
  std::uint64_t hash = 1469598103934665603ull;
  const auto add = [&](double v) { hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211ull; };
  const Particles& p = s.state().particles;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    for (const Vec3& v : {p.position(i), p.velocity(i)}) {
      add(v.x);
      add(v.y);
      add(v.z);
    }
    if (p.has("temperature")) add(p[field::temperature][i]);
  }
  for (std::size_t b = 0; b < s.state().bodies.size(); ++b) {
    for (const Vec3& v :
         {s.state().bodies[field::body_centre][b], s.state().bodies[field::body_angular_momentum][b]}) {
      add(v.x);
      add(v.y);
      add(v.z);
    }
  }
  return hash;
}

/// Two hot and cold blocks that fly past each other in a periodic box, spinning: everything that this build
/// has at once.
lab::Lab everything(Mode mode) {
  lab::Lab lab(1e-3, mode);
  lab.scene.gravity = {0.0, 0.0, -1e-3};
  lab.make_periodic({true, true, false}, {0.0, 0.0, 0.0}, {16, 12, 8});
  lab.add_material(300.0, 5.0, 800.0);
  lab.add({.name = "a",
           .count = {6, 6, 6},
           .velocity = {0.02, 0.001, 0.0},
           .angular_velocity = {0.5, 1.0, 2.0},
           .temperature = [](const Vec3& r) { return 300.0 + 1e4 * r.x; }});
  lab.add({.name = "b",
           .material = 1,
           .corner = {8e-3, 0.0, 0.0},
           .count = {5, 6, 6},
           .velocity = {-0.02, 0.0, 0.001},
           .temperature = [](const Vec3&) { return 350.0; }});
  return lab;
}

TEST(Simulation, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const lab::Lab lab = everything(mode);
    const Simulation one = lab.run(0.5, 1);
    EXPECT_GT(one.steps(), 20);
    EXPECT_GT(one.state().neighbours->rebuilds(), 3)
        << "the lists must have been built anew for this to prove anything";
    for (const int threads : {2, 3, 7})
      EXPECT_EQ(hash_of(lab.run(0.5, threads)), hash_of(one)) << threads << " threads";
  }
}

/// With one particle a cluster there are enough of them for strips (Clusters::visits), with four there are
/// not.
TEST(Simulation, GivesTheSameBitsWhereClustersAreVisitedInAnotherOrder) {
  if (!machine_has_avx2()) GTEST_SKIP() << "no clusters of four";
  for (const bool conducts : {false, true}) {
    lab::Lab lab(1e-3);
    lab.scene.gravity = {0.0, 0.0, -10.0};
    lab.scene.materials[0].stiffness = 4.0;
    lab::Block water{
        .name = "water", .count = {24, 24, 18}, .phase = Phase::liquid, .velocity = {0.3, 0.2, 0.0}};
    if (conducts) water.temperature = [](const Vec3& r) { return 300.0 + 1e4 * r.x; };
    lab.add(water);
    lab.add({.name = "floor",
             .corner = {0.0, 0.0, -3e-3},
             .count = {24, 24, 3},
             .motion = Motion::fixed,
             .temperature = water.temperature});
    const auto run = [&](int lanes) {
      Simulation s(lab.scene, lab.initial, {.threads = 2, .lanes = lanes});
      s.advance_to(4e-3);
      return s;
    };
    const Simulation one = run(1), four = run(4);
    EXPECT_FALSE(one.state().neighbours->clusters().visits.empty());
    EXPECT_TRUE(four.state().neighbours->clusters().visits.empty());
    EXPECT_GT(one.state().neighbours->rebuilds(), 3);
    EXPECT_EQ(hash_of(one), hash_of(four));
  }
}

TEST(Simulation, GivesAnEffectTheSameBitsAloneAndBesideAnother) {
  lab::Lab warm = everything(Mode::corrected), cold = everything(Mode::corrected);
  for (Body& b : cold.scene.bodies) b.temperature.reset();
  cold.initial.temperature.clear();
  warm.scene.time_step = cold.scene.time_step = 1e-2;
  const Simulation a = warm.run(0.5), b = cold.run(0.5);
  EXPECT_FALSE(b.state().neighbours.has_value());
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(a.state().bodies[field::body_centre][row], b.state().bodies[field::body_centre][row]);
    EXPECT_EQ(a.state().bodies[field::body_orientation][row], b.state().bodies[field::body_orientation][row]);
  }
}

TEST(Simulation, KeepsEnergyWhileListsAreBuiltAnewAndParticlesCrossTheSeam) {
  const lab::Lab lab = everything(Mode::corrected);
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(1.0);
  EXPECT_NEAR(s.ledger().energy.at("thermal") / before, 1.0, 1e-12);
}

TEST(Simulation, MeetsEveryOutputTimeExactly) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  Simulation s(lab.scene, lab.initial);
  for (const double time : {0.1, 0.37, 1.0, 10.0 / 3.0}) {
    s.advance_to(time);
    EXPECT_EQ(s.state().time, time);
  }
}

TEST(Simulation, TakesTheScenesTimeStepWhereItGivesOne) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.time_step = 0.01;
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.1);
  s.advance_to(1.0);
  EXPECT_EQ(s.steps(), 100);
  EXPECT_EQ(s.time_step_set_by(), "scene");
}

TEST(Simulation, NamesTheEffectWhoseBoundSetsTheStep) {
  lab::Lab spinning = lab::asymmetric_block({1.0, 2.0, 3.0});
  EXPECT_EQ(Simulation(spinning.scene, spinning.initial).time_step_set_by(), "rotation");
  EXPECT_NEAR(Simulation(spinning.scene, spinning.initial).bound().dt, 0.1 / std::sqrt(14.0), 1e-12);
  spinning.scene.gravity = {0.0, 0.0, -1e4};
  EXPECT_EQ(Simulation(spinning.scene, spinning.initial).time_step_set_by(), "acceleration");
  lab::Lab warm(1e-3);
  warm.add({.count = {4, 4, 4}, .motion = Motion::fixed, .temperature = [](const Vec3& r) {
              return 300.0 + r.x;
            }});
  EXPECT_EQ(Simulation(warm.scene, warm.initial).time_step_set_by(), "heat");
}

TEST(Simulation, RefusesAStepAboveABoundUnlessToldToForceIt) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.time_step = 0.25;
  EXPECT_THROW(Simulation(lab.scene, lab.initial), InputError);
  Simulation forced(lab.scene, lab.initial, {.force_time_step = true});
  forced.advance_to(1.0);
  EXPECT_EQ(forced.steps(), 4);
}

TEST(Simulation, OfAStaticSceneBuildsItsListsOnce) {
  lab::Lab lab(1e-3);
  lab.add({.count = {6, 6, 6}, .motion = Motion::fixed, .temperature = [](const Vec3& r) {
             return 300.0 + 1e3 * r.x;
           }});
  const Simulation s = lab.run(5.0);
  EXPECT_GT(s.steps(), 10);
  EXPECT_EQ(s.state().neighbours->rebuilds(), 1);
  const auto x = positions(s.state().particles);
  for (std::size_t id = 0; id < lab.initial.size(); ++id)
    EXPECT_EQ(x.at(s.state().particles.row(id)), lab.initial.position[id]);
}

}  // namespace
}  // namespace tripoint
