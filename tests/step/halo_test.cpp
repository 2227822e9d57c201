// SPDX-License-Identifier: BSD-3-Clause
// A scene that is shared out: simulations that each hold a slab of it, as threads of one process, against the
// simulation that holds all.
#include <gtest/gtest.h>

#include "scene/guard_name.hpp"
#include "step/slab_halo.hpp"

namespace tripoint {
namespace {

using lab::far, lab::greatest_difference, lab::Seen, lab::seen_shared, lab::seen_whole;

/// A column of jittered water that falls over between walls, which a block falls into.
test::Prepared splash(bool floats_oil = false) {
  Scene s;
  s.spacing = 0.01;
  s.jitter = 0.2;
  s.gravity = {0, 0, -9.81};
  s.periodic = {false, true, false};
  s.min = Vec3{-0.03, 0.0, -0.03};
  s.max = Vec3{0.18, 0.03, 0.2};
  Material water = test::material(1000.0), wood = test::material(500.0);
  water.name = "water";
  water.viscosity = 1e-3;
  water.stiffness = 400.0;
  wood.name = "wood";
  s.materials = {water, test::material(1000.0), wood};
  Body column;
  column.name = "water";
  column.material = "water";
  column.phase = Phase::liquid;
  column.shape = test::box({0, 0, 0}, {0.07, 0.03, 0.06});
  Shape tank;
  tank.kind = Shape::Kind::difference;
  tank.of = {test::box({-0.03, 0, -0.03}, {0.18, 0.03, 0.1}), test::box({0, 0, 0}, {0.15, 0.03, 0.2})};
  Body block = test::rigid("block", test::box({0.05, 0.0, 0.065}, {0.09, 0.02, 0.095}), {{0.2, 0, -1.0}, {}});
  block.material = "wood";
  s.bodies = {column, test::rigid("tank", tank, {}, Motion::fixed), block};
  if (floats_oil) {
    Material oil = water;
    oil.name = "oil";
    oil.density = 700.0;
    s.materials.push_back(oil);
    s.bodies[2] = column;
    s.bodies[2].name = "oil";
    s.bodies[2].material = "oil";
    s.bodies[2].shape = test::box({0, 0, 0.06}, {0.07, 0.03, 0.09});
    s.values["interface_weight"] = 1.0;
  }
  return test::prepare(s, 0.02, 1);
}

class Splash : public testing::TestWithParam<bool> {};
TEST_P(Splash, MovesSharedAsTheWholeDoes) {
  const test::Prepared p = splash(GetParam());
  const Seen whole = seen_whole(p);
  for (const std::vector<double>& planes :
       {std::vector<double>{-far, far}, {-far, 0.055, far}, {-far, 0.021, 0.0634, 0.1, far}}) {
    SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
    const Seen shared = seen_shared(p, planes);
    EXPECT_GT(shared.migrations, 3);
    EXPECT_EQ(greatest_difference(whole.position, shared.position), 0.0)
        << "every sum that moves something has its order";
    EXPECT_EQ(greatest_difference(whole.velocity, shared.velocity), 0.0);
    ASSERT_EQ(whole.ledger.energy.size(), shared.ledger.energy.size());
    for (const auto& [entry, joule] : whole.ledger.energy)
      EXPECT_NEAR(joule, shared.ledger.energy.at(entry), 1e-11) << entry;
    EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Halo, Splash, testing::Bool());

/// The block is held for a while, for which each gathers the whole: lists of the liquid stay those of before,
/// as in one process.
TEST(Halo, ListsOutliveWhatIsDecidedOfTheWhole) {
  test::Prepared p = splash();
  Event hold;
  hold.kind = Event::Kind::hold;
  hold.time = 0.0071;
  hold.until = 0.0093;
  hold.bodies = {"block"};
  p.job.scene.events = {hold};
  const Seen whole = seen_whole(p);
  for (const Checkpoint* from : {static_cast<const Checkpoint*>(nullptr), &whole.kept}) {
    SCOPED_TRACE(from ? "from the checkpoint of half time" : "from the start");
    const Seen shared = seen_shared(p, {-far, 0.055, far}, "", from);
    EXPECT_EQ(greatest_difference(whole.position, shared.position), 0.0);
    EXPECT_EQ(greatest_difference(whole.velocity, shared.velocity), 0.0);
    EXPECT_GE(shared.gatherings, from ? 1 : 3) << "as it is held, let go and kept";
    EXPECT_EQ(shared.shares, 1) << "that of the start: then each part goes on with what it had";
  }
}

TEST(Halo, AColumnThatIsNotHandedOnIsSeen) {
  const test::Prepared p = splash();
  const Seen whole = seen_whole(p);
  for (const char* column : {"number_density", "force.x", "viscous_force.z"}) {
    const Seen shared = seen_shared(p, {-far, 0.055, far}, column);
    EXPECT_GT(greatest_difference(whole.velocity, shared.velocity), 1e-9) << column;
  }
}

/// A jittered bar with a wave of temperature along x, one third of it held at what it starts with.
test::Prepared held_bar() {
  TemperatureField wave;
  wave.kind = TemperatureField::Kind::cosine;
  wave.mean = 300.0;
  wave.amplitude = 40.0;
  wave.wave_vector = {20.0, 0, 0};
  Scene s = test::bar(24, 0.3, wave, false, 60.0, 1).job.scene;
  s.jitter = 0.1;
  Body held = s.bodies[0];
  held.name = "held";
  held.temperature_held = true;
  held.shape = test::box({0.2, 0, 0}, s.bodies[0].shape.max);
  s.bodies[0].shape.max.x = 0.2;
  s.bodies.push_back(held);
  return test::prepare(s, 60.0, 1);
}

/// Both slabs hold particles that are held: each sums its own.
TEST(Halo, TheHeatThatABodyWasGivenIsTheSumOverAllSlabs) {
  const test::Prepared p = held_bar();
  const std::vector<double> whole = seen_whole(p).kept.real.at("bodies/body.heat");
  const std::vector<double> shared = seen_shared(p, {-far, 0.25, far}).kept.real.at("bodies/body.heat");
  ASSERT_EQ(whole.size(), 2u);
  ASSERT_EQ(shared.size(), 2u);
  EXPECT_GT(std::abs(whole[1]), 1.0) << "J: the flow through the end of the held part, some watts";
  EXPECT_NEAR(shared[1] / whole[1], 1.0, 1e-11) << "round-off of sums in another order";
}

/// A soft bar that is thrown along x and swings, of elastic or of ductile matter, and a block of the same
/// that it meets, if there is to be one.
test::Prepared thrown_bar(bool flows, bool meets, double spin, double bending) {
  Scene s;
  s.spacing = 0.01;
  s.jitter = 0.1;
  s.values["bending"] = bending;
  Material rubber = test::material(1000.0);
  rubber.young_modulus = 3e5;
  rubber.poisson_ratio = 0.3;
  rubber.stiffness = 100.0;
  if (flows) rubber.elastic_limit = 0.001;
  s.materials = {rubber};
  Body bar = test::rigid("bar", test::box({0, 0, 0}, {0.12, 0.04, 0.03}), {{0.5, 0, 0}, {0, 0, spin}});
  bar.phase = Phase::elastic;
  Body block = test::rigid("block", test::box({0.124, 0, 0}, {0.184, 0.05, 0.03}), {{-0.5, 0, 0}, {}});
  block.phase = Phase::elastic;
  s.bodies = {bar};
  if (meets)
    s.bodies.push_back(block);
  else
    s.unguarded = {GuardName::inversion};
  return test::prepare(s, meets ? 0.01 : 0.02, 1);
}

TEST(Halo, ElasticBodiesThatAreSharedMoveAsTheWholeDoes) {
  for (const bool flows : {false, true}) {
    test::Prepared p = thrown_bar(flows, true, 5.0, flows ? 0.0 : 1.0);
    p.job.scene.values["face_pressure"] = flows ? 1.0 : 0.0;
    p.job.scene.values["contact_step"] = flows ? 0.3 : 0.0;
    const Seen whole = seen_whole(p);
    for (const std::vector<double>& planes : {std::vector<double>{-far, 0.1, far}, {-far, 0.04, 0.13, far}}) {
      SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs" + (flows ? ", plastic" : ""));
      const Seen shared = seen_shared(p, planes);
      EXPECT_GT(shared.migrations, 3);
      EXPECT_EQ(greatest_difference(whole.position, shared.position), 0.0);
      EXPECT_EQ(greatest_difference(whole.velocity, shared.velocity), 0.0);
      ASSERT_EQ(whole.ledger.energy.size(), shared.ledger.energy.size());
      for (const auto& [entry, joule] : whole.ledger.energy)
        EXPECT_NEAR(joule, shared.ledger.energy.at(entry), 1e-11) << entry;
      EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, 1e-11);
      EXPECT_NEAR(norm(whole.ledger.angular_momentum - shared.ledger.angular_momentum), 0.0, 1e-11);
    }
  }
}

/// Without contact there are no neighbour lists: what is torn apart by the defect flies on, and no guard ends
/// it.
TEST(Halo, WhatAnElasticParticleDoesNotBringAlongIsSeen) {
  const test::Prepared p = thrown_bar(true, false, 40.0, 0.0);
  const Seen whole = seen_whole(p);
  EXPECT_GT(whole.ledger.energy.at("plastic"), 1e-6);
  const std::vector<double> planes{-far, 0.062, far};
  const Seen right = seen_shared(p, planes);
  EXPECT_GT(right.migrations, 3);
  EXPECT_EQ(greatest_difference(whole.velocity, right.velocity), 0.0);
  for (const char* column :
       {"bonds", "deformation", "elastic_force.x", "shape_inverse.xy", "solid_volume", "plastic_strain.xx"}) {
    const Seen shared = seen_shared(p, planes, column);
    EXPECT_GT(greatest_difference(whole.velocity, shared.velocity), 1e-9) << column;
  }
}

}  // namespace
}  // namespace tripoint
