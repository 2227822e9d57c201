// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "files/job.hpp"
#include "metrics/frames.hpp"
#include "validation/metrics/metric_value.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Still;

/// A block of 4 x 4 x 4 with its lower corner at the origin, above a floor.
Still block_above_floor() {
  test::Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -10};
  test::add_body(s, "block", {{4, 4, 4}, 0.1, {}, 2.0}, {});
  test::add_body(s, "floor", {{4, 4, 1}, 0.1, {0, 0, -0.5}, 1.0}, {}, Motion::fixed);
  test::set_times(s, 1.0, 4);
  return Still(s);
}

const Settings floor_at_0{{"axis", std::string("z")}, {"value", 0.0}};

TEST(ImpactMetrics, MeasureHowDeepASurfaceSinks) {
  Still f = block_above_floor();
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.0, 1e-15);
  f.run.frames[2].bodies[0].position.z -= 0.03;
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.03, 1e-15);
  EXPECT_NEAR(f.stated(metric("sunk", "final", "block"), floor_at_0), 0.0, 1e-15);
  f.run.frames[2].bodies[0].position.z += 0.5;
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.0, 1e-15)
      << "above the floor nothing sinks";
}

TEST(ImpactMetrics, TurnTheSurfaceWithItsBody) {
  Still f = block_above_floor();
  f.run.frames[3].bodies[0].orientation =
      from_rotation_vector({test::pi / 4.0, 0, 0});  // onto an edge: sqrt(2) times as deep below the centre
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.2 * (std::sqrt(2.0) - 1.0), 1e-14);
}

TEST(ImpactMetrics, KnowSpheresAndUnions) {
  Still f = block_above_floor();
  Shape ball;
  ball.kind = Shape::Kind::sphere;
  ball.centre = {0.2, 0.2, 0.2};
  ball.radius = 0.25;
  f.s.job.scene.bodies[0].shape = ball;
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.05, 1e-15);
  Shape both;
  both.kind = Shape::Kind::unite;
  both.of = {ball, ball};
  both.of[1].radius = 0.3;
  f.s.job.scene.bodies[0].shape = both;
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.1, 1e-15);
  Shape rod;  // lies along x, and its rim reaches below the floor
  rod.kind = Shape::Kind::cylinder;
  rod.base = {0.0, 0.2, 0.2};
  rod.axis = {1, 0, 0};
  rod.length = 0.4;
  rod.radius = 0.25;
  f.s.job.scene.bodies[0].shape = rod;
  EXPECT_NEAR(f.stated(metric("sunk", "max", "block"), floor_at_0), 0.05, 1e-15);
  f.s.job.scene.bodies[0].shape.kind = Shape::Kind::half_space;
  EXPECT_TRUE(std::isnan(f.stated(metric("sunk", "max", "block"), floor_at_0)));
}

TEST(ImpactMetrics, SeeEnergyThatIsMadeAfterSomeWasLost) {
  Still f = block_above_floor();
  const double height[] = {0.0, -0.5, -0.9, -0.6, -0.7};  // at rest in each frame: energy is m g z
  for (std::size_t n = 0; n < 5; ++n) f.shift(f.run.frames[n], 0, {0, 0, height[n]});
  const MetricValue gain = f.of(metric("energy_gain", "max"), "invariant");
  EXPECT_NEAR(gain.value, 2.0 * 10.0 * 0.3, 1e-12);
  ASSERT_EQ(gain.series.size(), 5u);
  ASSERT_EQ(gain.times.size(), 5u);
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_NEAR(gain.series[n] - gain.series[0], 2.0 * 10.0 * height[n], 1e-12) << n;
  for (std::size_t n = 0; n < 5; ++n) f.shift(f.run.frames[n], 1, {0, 0, -height[n]});
  EXPECT_NEAR(f.of(metric("energy_gain", "max"), "invariant").value, 6.0, 1e-12)
      << "a held body has no energy to lose";
}

/// Puts the block of `block_above_floor` to a height above its start, with a speed up.
void put(Still& f, std::size_t n, double height, double speed) {
  f.shift(f.run.frames[n], 0, {0, 0, height});
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 0) f.run.frames[n].velocity[i] = {0, 0, speed};
}

/// Frames every 0.25 s of a fall, a hit in which the block stands, and the way up.
Still bounce(double speed_after) {
  Still f = block_above_floor();
  const double v = speed_after;
  put(f, 1, -0.3125, -2.5);
  put(f, 2, -1.25, -5.0);
  put(f, 3, -1.3, 0.0);  // the contact holds all energy
  put(f, 4, -1.25 + 0.25 * v - 0.3125, v - 2.5);
  return f;
}

TEST(ImpactMetrics, CallAnElasticReboundNoGain) {
  EXPECT_NEAR(bounce(5.0).of(metric("energy_gain", "max"), "invariant").value, 0.0, 1e-12);
  EXPECT_NEAR(bounce(6.0).of(metric("energy_gain", "max"), "invariant").value, 11.0, 1e-12)
      << "m (6^2 - 5^2) / 2 is made";
}

TEST(ImpactMetrics, LetAnElasticBodyGiveBackWhatItStored) {
  Still f = block_above_floor();
  f.run.frames.front().velocity.assign(f.s.initial.size(), {0, 0, 2});  // every particle swings up and down
  f.s.job.scene.gravity = {};
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 0) f.s.initial.phase[i] = static_cast<int>(Phase::elastic);
  f.run.frames.back().velocity.assign(f.s.initial.size(), {0, 0, 2});
  EXPECT_NEAR(f.of(metric("energy_gain", "max"), "invariant").value, 0.0, 1e-12);
  f.run.frames.back().velocity.assign(f.s.initial.size(), {0, 0, 3});
  EXPECT_NEAR(f.of(metric("energy_gain", "max"), "invariant").value, 5.0, 1e-12);
}

/// What pushes a body gives it energy, and no engine makes it.
TEST(ImpactMetrics, KnowNoGainWhereSomethingPushes) {
  Still pushed = block_above_floor();
  pushed.s.job.scene.forces.emplace_back();
  EXPECT_TRUE(std::isnan(pushed.of(metric("energy_gain", "max"), "invariant").value));
  Still led = block_above_floor();
  led.s.job.bodies[1].motion = Motion::prescribed;
  EXPECT_EQ(led.of(metric("energy_gain", "max"), "invariant").value, 0.0) << "it stands";
  led.s.job.bodies[1].velocity = {1, 0, 0};
  EXPECT_TRUE(std::isnan(led.of(metric("energy_gain", "max"), "invariant").value));
}

TEST(ImpactMetrics, CallAFallNoGain) {
  Still f = block_above_floor();
  for (auto& frame : f.run.frames) {
    f.shift(frame, 0, {0, 0, -5.0 * frame.time * frame.time});
    for (std::size_t i = 0; i < f.s.initial.size(); ++i)
      if (f.s.initial.source[i] == 0) frame.velocity[i] = {0, 0, -10.0 * frame.time};
  }
  EXPECT_NEAR(f.of(metric("energy_gain", "max"), "invariant").value, 0.0, 1e-11);
}

}  // namespace
}  // namespace tripoint
