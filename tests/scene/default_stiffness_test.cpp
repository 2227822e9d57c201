// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <string>

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
  s.materials[0].density = 1000.0;
  Body b;
  b.name = b.material = "water";
  b.shape.min = {0.0, 0.0, 1.0};
  b.shape.max = {1.0, 1.0, 3.0};
  s.bodies = {b};
  return s;
}

/// Adds a rigid box of water's density.
Body& add_box(Scene& s, const char* name, Motion motion, const Vec3& min, const Vec3& max) {
  Body& b = s.bodies.emplace_back(s.bodies[0]);
  b.name = name;
  b.phase = Phase::rigid;
  b.motion = motion;
  b.shape.min = min;
  b.shape.max = max;
  return b;
}

TEST(DefaultStiffness, MakesSoundTenTimesAsFastAsTheLiquidCanFall) {
  EXPECT_NEAR(default_stiffness(tank())->value, 100.0 * 40.0, 1e-9);
}

TEST(DefaultStiffness, CountsTheDropOfASolidAboveTheLiquid) {
  Scene s = tank();
  s.end_time = 2.0;
  s.spacing = 0.1;
  add_box(s, "floor", Motion::fixed, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  Body& ball = add_box(s, "ball", Motion::free, {0.4, 0.4, 6.0}, {0.6, 0.6, 6.2});
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 60.0, 300.0);  // 3 m through air
  s.materials.push_back(s.materials[0]);
  s.materials[1].name = ball.material = "steel";
  s.materials[1].density = 8000.0;
  EXPECT_NEAR(default_stiffness(s)->value, 800.0 * 95.0, 2400.0);
  ball.material = "water";
  ball.shape.min.z = 1.5;
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 40.0, 1e-9);
}

TEST(DefaultStiffness, CountsTheFallOfLiquidToAFloor) {
  Scene s = tank();
  s.end_time = 2.0;
  s.spacing = 0.1;
  add_box(s, "floor", Motion::fixed, {0.0, 0.0, -1.0}, {1.0, 1.0, 0.0});
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 60.0, 300.0);
  s.bodies[0].velocity.value = {0.0, 0.0, -5.0};
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 85.0, 300.0);
  s.bodies[0].velocity.value = {};
  s.end_time = 0.1;  // it does not get there
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 40.0, 1e-9);
}

TEST(DefaultStiffness, IsFoundAtOnceWhereNothingStopsAFallAndWhereMuchDoes) {
  Scene s = tank();
  s.spacing = 1e-3;
  s.end_time = 1e6;
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 40.0, 1e-9);
  for (int n = 0; n < 1000; ++n) {
    const double x = 0.1 * (n % 10), y = 0.1 * (n / 10 % 10), z = 1.0 + 0.1 * (n / 100);
    add_box(s, ("box" + std::to_string(n)).c_str(), Motion::free, {x, y, z}, {x + 0.09, y + 0.09, z + 0.09});
  }
  add_box(s, "floor", Motion::fixed, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NEAR(default_stiffness(s)->value, 100.0 * 40.0, 1e-9);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
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

/// A cube that hits another, between x = 0 and 3 m.
Scene hit() {
  Scene s = tank();
  s.gravity = {};
  s.end_time = 1.0;
  s.spacing = 0.1;
  for (const double x : {0.0, 2.0}) {
    Body b = s.bodies[0];
    b.name = x == 0.0 ? "left" : "right";
    b.phase = Phase::rigid;
    b.shape.min.x = x;
    b.shape.max.x = x + 1.0;
    b.velocity.value = {x == 0.0 ? 3.0 : 0.0, 0.0, 0.0};
    s.bodies.push_back(b);
  }
  s.bodies.erase(s.bodies.begin());
  return s;
}

/// A body 50 m away, of matter of another density.
void put_far_away(Scene& s, Phase phase, double density) {
  s.materials.push_back({});
  s.materials.back().name = "far";
  s.materials.back().density = density;
  Body b = s.bodies[0];
  b.name = b.material = "far";
  b.phase = phase;
  b.velocity.value = {};
  b.shape.min.x = 50.0;
  b.shape.max.x = 51.0;
  s.bodies.push_back(b);
}

/// Greatest pressure that the equation of state knows: k times the density of reference (model 8.3).
double hardness(const Scene& s, double reference) { return default_stiffness(s)->value * reference; }

TEST(DefaultStiffness, OfAHitKnowsNothingOfBodiesFarAway) {
  const double alone = hardness(hit(), 1000.0);
  EXPECT_NEAR(alone, 1000.0 * 100.0 * 9.0, 1e-6);
  Scene heavy = hit(), wet = hit(), falls = hit();
  put_far_away(heavy, Phase::rigid, 5000.0);
  EXPECT_NEAR(hardness(heavy, 5000.0), alone, 1e-6);
  put_far_away(wet, Phase::liquid, 800.0);
  EXPECT_NEAR(hardness(wet, 800.0), alone, 1e-6);
  falls.gravity = {0.0, 0.0, -10.0};
  const double fall = hardness(falls, 1000.0);
  put_far_away(falls, Phase::rigid, 1000.0);
  falls.bodies.back().shape.max.z = 40.0;
  falls.bodies.back().motion = Motion::fixed;
  EXPECT_NEAR(hardness(falls, 1000.0), fall, 1e-6);
}

TEST(DefaultStiffness, OfLiquidAtRestIsFoundToo) {
  Scene s = hit();
  for (Body& b : s.bodies) b.velocity.value = {};
  put_far_away(s, Phase::liquid, 800.0);
  EXPECT_NEAR(default_stiffness(s)->value, 1.0, 1e-12);  // ten spacings in the time of the run
}

TEST(DefaultStiffness, IsThatOfTheSceneThatRuns) {
  Case c;
  c.scene = tank();
  EXPECT_NEAR(scene_for(c, {}).materials[0].stiffness.value(), 4000.0, 1e-9);
}

}  // namespace
}  // namespace tripoint
