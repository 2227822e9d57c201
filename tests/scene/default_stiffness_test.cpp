// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scene/defaults.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace {

/// Water 2 m deep under g = 10 m/s2: it can fall at sqrt(2 g H) = sqrt(40) m/s.
Scene tank() {
  Scene s;
  s.gravity = {0.0, 0.0, -10.0};
  s.materials.resize(1);
  s.materials[0].name = "water";
  Body b;
  b.name = b.material = "water";
  b.shape.min = {0.0, 0.0, 1.0};
  b.shape.max = {1.0, 1.0, 3.0};
  s.bodies = {b};
  return s;
}

TEST(DefaultStiffness, MakesSoundTenTimesAsFastAsTheLiquidCanFall) {
  EXPECT_NEAR(default_stiffness(tank())->value, 100.0 * 40.0, 1e-9);
}

TEST(DefaultStiffness, FollowsTheFastestBodyWhereThatIsFaster) {
  Scene s = tank();
  s.bodies.push_back(s.bodies[0]);
  s.bodies[1].phase = Phase::rigid;
  s.bodies[1].motion = Motion::prescribed;
  s.bodies[1].keyframes = {{0.0, {}, {}}, {0.5, {0.0, 6.0, 0.0}, {}}};
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 144.0, 1e-9);
  s.bodies[0].velocity.value = {0.0, 0.0, -20.0};
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 400.0, 1e-9);
}

TEST(DefaultStiffness, LeavesAloneWhatIsGivenAndWhatNeitherFlowsNorMoves) {
  Scene given = tank(), solid = tank(), still = tank();
  given.materials[0].stiffness = 7.0;
  solid.bodies[0].phase = Phase::rigid;
  still.gravity = {};
  for (const Scene& s : {given, solid, still}) EXPECT_FALSE(default_stiffness(s));
}

TEST(DefaultStiffness, IsThatOfTheSceneThatRuns) {
  Case c;
  c.scene = tank();
  EXPECT_NEAR(scene_for(c, {}).materials[0].stiffness.value(), 4000.0, 1e-9);
}

}  // namespace
}  // namespace tripoint
