// SPDX-License-Identifier: BSD-3-Clause
#include "step/guard.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "effects/lab.hpp"

namespace tripoint {
namespace {

lab::Lab warm() {
  lab::Lab lab(1e-3);
  lab.add({.count = {4, 4, 4}, .motion = Motion::fixed, .temperature = [](const Vec3& r) { return 300.0 + 1e4 * r.x; }});
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
  World world{s.world()};
  world.particles[field::heat_rate][world.particles.row(9)] = std::nan("");
  world.particles[field::temperature][world.particles.row(11)] = INFINITY;
  try {
    check_finite(world);
    FAIL();
  } catch (const Diverged& e) {
    EXPECT_EQ(e.particle, 11);
    EXPECT_EQ(e.field, "temperature");
    EXPECT_EQ(e.stage, "drift");
  }
}

}  // namespace
}  // namespace tripoint
