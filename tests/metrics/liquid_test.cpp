// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "metrics/fakes.hpp"
#include "references/liquids.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::pi;

/// A scene and a run of it whose particles stay in place and show the truth's velocity, pressure and density.
struct Flow {
  test::Prepared s;
  std::shared_ptr<const Reference> truth;
  Trajectory run;
  Flow(test::Prepared prepared, const std::string& name)
      : s(std::move(prepared)), truth(make_reference(test::function(name), s.job, s.initial)) {
    for (const double t : s.job.times) {
      Snapshot frame = truth->at(t);
      frame.position = s.initial.position;
      if (frame.velocity.empty()) frame.velocity = s.initial.velocity;
      frame.mass = s.initial.mass;
      if (frame.bodies.empty())
        for (const auto& b : s.job.bodies)
          if (b.index >= 0) {
            frame.bodies.emplace_back();
            frame.bodies.back().position = b.properties.centre;
          }
      run.frames.push_back(frame);
    }
  }
  [[nodiscard]] double value(const MetricChoice& choice) const {
    return evaluate(choice, s.job, s.initial, run, *truth).value;
  }
};

TEST(LiquidMetrics, ReadTwiceThePressureAsAFactor) {
  Flow f(test::layers(5.0), "hydrostatic");
  EXPECT_NEAR(f.value(metric("pressure_factor", "mean")), 0.0, 1e-12);
  for (auto& frame : f.run.frames)
    for (double& p : frame.pressure) p *= 2.1;
  EXPECT_NEAR(f.value(metric("pressure_factor", "mean")), 1.1, 1e-12);
}

TEST(LiquidMetrics, SeeTheInterfaceFromTheChosenSide) {
  Flow f(test::layers(5.0), "hydrostatic");
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.pressure.size(); ++i) {
      const double z = f.s.initial.position[i].z;
      frame.pressure[i] += z > 0.4 && z < 0.5 ? 30.0 : z > 0.5 ? 1000.0 : 0.0;
      frame.density[i] += z > 0.4 && z < 0.5 ? 7.0 : 0.0;
    }
  EXPECT_NEAR(f.value(metric("interface_pressure", "mean", "light")), 30.0, 1e-9);
  EXPECT_NEAR(f.value(metric("interface_pressure", "mean", "heavy")), 0.0, 1e-9);
  EXPECT_NEAR(f.value(metric("interface_density", "mean", "light")), 7.0, 1e-9);
}

TEST(LiquidMetrics, CountAParticleAtExactlyOneSpacingFromTheInterface) {
  Flow f(test::layers(5.0), "hydrostatic");
  double second = 1.0;  // height of the light liquid's second layer; the interface is at 0.4
  for (const Vec3& r : f.s.initial.position)
    if (r.z > 0.5) second = std::min(second, r.z);
  f.s.job.scene.spacing = second - 0.4;
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.pressure.size(); ++i) {
      const double z = f.s.initial.position[i].z;
      if (z > 0.4) frame.pressure[i] += z < 0.5 ? 30.0 : z == second ? 50.0 : 1000.0;
    }
  EXPECT_NEAR(f.value(metric("interface_pressure", "mean", "light")), 40.0, 1e-9);
}

TEST(LiquidMetrics, MeanOverTimeLosesASwingAndKeepsAnOffset) {
  Flow f(test::layers(5.0), "hydrostatic");
  // Five frames: 3 x 40 - 2 x 60 = 0
  for (std::size_t n = 0; n < f.run.frames.size(); ++n)
    for (double& p : f.run.frames[n].pressure) p += 5.0 + (n % 2 == 0 ? 40.0 : -60.0);
  EXPECT_NEAR(f.value(metric("pressure", "L2mean")), 5.0, 1e-9);
  EXPECT_GT(f.value(metric("pressure", "rms")), 30.0);
}

TEST(LiquidMetrics, JudgeVelocitiesOfALiquidBodyByItsParticles) {
  Flow f(test::channel({0.08, 0, 0}, {}), "poiseuille");
  EXPECT_NEAR(f.value(metric("velocity", "Linf", "liquid")), 0.0, 1e-15);
  f.run.frames.back().velocity[3].y += 0.25;
  EXPECT_NEAR(f.value(metric("velocity", "Linf", "liquid")), 0.25, 1e-12);
}

TEST(LiquidMetrics, MeasureTheDraughtByTheVolumeOfTheLiquid) {
  Flow f(test::pool(500.0), "archimedes");
  // 0.5 m3 of water in 1 m2 and a block of 0.16 m2: keel at 0.4 m gives the level 0.4 + (0.5 - 0.4)/0.84.
  for (auto& frame : f.run.frames) frame.bodies[0].position.z = 0.6;
  EXPECT_NEAR(f.value(metric("draught", "mean", "block")), 0.1 / 0.84 - 0.2, 1e-12);
}

TEST(LiquidMetrics, FindTheFrequencyOfADampedWave) {
  Flow f(test::swinging(test::sound_start(), 20), "sound_wave");
  const double w = 0.7 * 10 * 2 * pi;
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.velocity.size(); ++i)
      frame.velocity[i] = {0.01 * std::cos(2 * pi * f.s.initial.position[i].x + 0.7) *
                               std::exp(-3 * frame.time) * std::cos(w * frame.time + 0.2),
                           0, 0};
  EXPECT_NEAR(f.value(metric("frequency_squared", "final")), 0.49 - 1.0, 1e-9);
}

TEST(LiquidMetrics, TimeATouchAndAnAcceleration) {
  Flow f(test::cubes(), "elastic_collision");
  EXPECT_NEAR(f.value(metric("touch_time", "final", "left")), 0.0,
              0.006);  // half a frame, 0.5 s/50/2, and the step between two frames
  auto s = test::pool(500.0);
  s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
  Flow g(s, "added_mass");
  for (auto& frame : g.run.frames) frame.bodies[0].velocity = {0, 0, 4.0 * frame.time};
  EXPECT_NEAR(g.value(metric("acceleration", "final", "block")), 4.0 - 0.5 * 9.81, 1e-9);
}

TEST(LiquidMetrics, AnAccelerationThatChangesWithinItsWindowIsNoSurerForMoreFrames) {
  const auto uncertainty = [](int frames, double per_second) {
    auto s = test::pool(500.0);
    s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
    s.job.times.clear();
    for (int n = 0; n <= frames; ++n) s.job.times.push_back(1.0 * n / frames);
    Flow f(s, "added_mass");
    for (auto& frame : f.run.frames)
      frame.bodies[0].velocity = {0, 0, 4.0 * frame.time + 0.5 * per_second * frame.time * frame.time};
    return evaluate(metric("acceleration", "final", "block"), f.s.job, f.s.initial, f.run, *f.truth)
        .uncertainty.numerical;
  };
  EXPECT_NEAR(uncertainty(20, 0.0), 0.0, 1e-9);
  // A parabola 1/2 b t^2 is off its line by b/2 ((t - 1/2)^2 - 1/12): squares of b^2/720 on average, and two
  // changes of sign, so that 4 - 2 are left over 1/12.
  EXPECT_NEAR(uncertainty(200, -3.0), 3.0 * std::sqrt(12.0 / 720.0 / 2.0), 0.02);
  EXPECT_NEAR(uncertainty(20, -3.0), uncertainty(200, -3.0), 0.05);
}

}  // namespace
}  // namespace tripoint
