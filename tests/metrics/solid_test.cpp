// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "metrics/frames.hpp"
#include "references/solids.hpp"
#include "validation/case/choices.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::pi;
using test::Still;

/// Moves the last layer of the beam's particles down, as a bent beam would.
void bend(Still& f, Snapshot& frame, double by) {
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 0)
      frame.position[i].z -= by * std::pow(f.s.initial.position[i].x / 0.195, 2);
}

TEST(SolidMetrics, ReadTheDeflectionOfTheLastLayer) {
  Still f(test::beam(2.0));
  const double truth =
      *make_reference(test::function("cantilever"), f.s.job, f.s.initial)->number("deflection");
  bend(f, f.run.frames.back(), truth + 1e-3);
  EXPECT_NEAR(f.of(metric("deflection", "final"), "cantilever").value, 1e-3, 1e-12);
  EXPECT_TRUE(std::isnan(f.stated(metric("deflection", "final", "beam"), {{"value", 0.0}})));
}

TEST(SolidMetrics, ReadTheDeflectionOfARigidTip) {
  Still f(test::beam(2.0, true));
  const Settings args{{"tip", std::string("tip")}};
  const double truth =
      *make_reference(test::function("cantilever", args), f.s.job, f.s.initial)->number("tip_deflection");
  f.run.frames.back().bodies[2].position += Vec3{0.01, 0, -truth - 2e-3};
  EXPECT_NEAR(f.of(metric("deflection", "final", "tip"), "cantilever", args).value, 2e-3, 1e-12);
}

TEST(SolidMetrics, FindOffsetAndFrequencyOfASwing) {
  Still f(test::beam(2.0));
  const auto truth = make_reference(test::function("cantilever"), f.s.job, f.s.initial);
  const double w = 0.93 * *truth->number("frequency"), sag = 1.08 * *truth->number("deflection");
  for (auto& frame : f.run.frames) bend(f, frame, sag * (1 - std::cos(w * frame.time)));
  // Golden section: square root of round-off
  EXPECT_NEAR(f.of(metric("frequency", "final"), "cantilever").value, -0.07, 1e-8);
  EXPECT_NEAR(f.of(metric("sag", "final"), "cantilever").value, 0.08, 1e-8);
  // a second mode
  for (auto& frame : f.run.frames) bend(f, frame, 0.03 * sag * std::cos(6.2 * w * frame.time));
  // 3 % of another mode over two periods
  EXPECT_NEAR(f.of(metric("frequency", "final"), "cantilever").value, -0.07, 2e-3);
  EXPECT_NEAR(f.of(metric("sag", "final"), "cantilever").value, 0.08, 5e-3);
}

TEST(SolidMetrics, RefuseASwingFarFromTheTruth) {
  Still f(test::beam(2.0));
  const double w =
      5.0 * *make_reference(test::function("cantilever"), f.s.job, f.s.initial)->number("frequency");
  for (auto& frame : f.run.frames) bend(f, frame, 1e-3 * std::exp(w * frame.time / 50));
  EXPECT_TRUE(std::isnan(f.of(metric("frequency", "final"), "cantilever").value));
}

TEST(SolidMetrics, MeasureAStretchWhateverTheTurn) {
  Still f(test::beam(0.0));
  const Quaternion turn = from_rotation_vector({0.3, 1.0, -0.4});
  for (std::size_t i = 0; i < f.s.initial.size(); ++i) {
    auto& r = f.run.frames.back().position[i];
    r = rotate(turn, {1.02 * r.x, r.y, r.z});
  }
  f.s.job.scene.periodic = {false, false, false};
  const Settings stated{{"axis", std::string("x")}, {"value", 1.0}};
  EXPECT_NEAR(f.stated(metric("stretch", "final", "beam"), stated), 0.02, 1e-12);
  auto middle = stated;
  middle["gauge"] = 0.5;
  EXPECT_NEAR(f.stated(metric("stretch", "final", "beam"), middle), 0.02, 1e-12);
}

TEST(SolidMetrics, SeeASpinTurnBack) {
  Still f(test::blocks());
  const auto& centre = f.s.job.bodies[0].properties.centre;
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < f.s.initial.size(); ++i) {
      const double rate = frame.time < 0.9 ? 2.0 : -1.7;
      frame.velocity[i] = Vec3{5, 0, 0} + cross({0, rate, 0}, frame.position[i] - centre);
    }
  EXPECT_NEAR(f.stated(metric("spin_ratio", "final", "left"), {{"value", 1.0}}), -1.85, 1e-12);
}

TEST(SolidMetrics, CompareTheShapeOfAnElasticBodyWhenItIsNamed) {
  Still f(test::blocks());
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 0) f.run.frames.back().position[i].x *= 1.01;
  EXPECT_NEAR(f.stated(metric("shape", "final", "left")), 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(f.stated(metric("shape", "final"))));  // no rigid body, and none is named
}

/// The bar as the truth says, with the force on the held and the pulled block.
Still stretched_bar(const test::Prepared& s, const Settings& args = {}) {
  Still f(s);
  const auto truth = make_reference(test::function("tension", args), f.s.job, f.s.initial);
  for (auto& frame : f.run.frames) {
    for (std::size_t i = 0; i < f.s.initial.size(); ++i)
      if (f.s.initial.source[i] == 0) frame.position[i].x *= *truth->number_at("stretch", frame.time);
    frame.bodies[0].force = {*truth->number_at("reaction", frame.time), 0, 0};
    frame.bodies.resize(3);
    frame.bodies[1].force = frame.bodies[0].force;
    frame.bodies[2].force = -1.0 * frame.bodies[0].force;
    frame.bodies[1].position = f.s.job.bodies[1].properties.centre;
    frame.bodies[2].position = f.s.job.bodies[2].properties.centre;
  }
  return f;
}

TEST(SolidMetrics, ReadModulusAndReactionAtBothEnds) {
  auto f = stretched_bar(test::driven_bar(1.02));
  auto window = [](MetricChoice m) {
    m.window = {0.5, 1.5};
    return m;
  };
  for (const char* end : {"held", "pulled"}) {
    EXPECT_NEAR(f.of(metric("reaction", "max", end), "tension").value, 0.0, 1e-6) << end;
    EXPECT_NEAR(f.of(window(metric("modulus", "mean", end)), "tension").value, 0.0, 1e-9) << end;
  }
  EXPECT_NEAR(f.of(metric("stretch", "max"), "tension").value, 0.0, 1e-12);
  for (auto& frame : f.run.frames)
    for (auto& b : frame.bodies) b.force = 0.81 * b.force;
  EXPECT_NEAR(f.of(window(metric("modulus", "mean", "held")), "tension").value, -0.19, 1e-9);
  // The first frame has no stretch
  EXPECT_TRUE(std::isnan(f.of(metric("modulus", "mean", "held"), "tension").value));
}

TEST(SolidMetrics, FindTheResidualStretchOfACycle) {
  auto s = test::driven_bar(1.03);
  s.job.scene.materials[0].elastic_limit = 0.0106;
  const auto f = stretched_bar(s);
  EXPECT_NEAR(f.of(metric("residual_stretch", "final", "held"), "tension").value, 0.0,
              1e-6);  // straight between frames: half a step squared, 9e-8
  auto g = f;
  for (auto& frame : g.run.frames) frame.bodies[1].force -= Vec3{100, 0, 0};
  EXPECT_GT(g.of(metric("residual_stretch", "final", "held"), "tension").value, 1e-3);
  const auto elastic = stretched_bar(test::driven_bar(1.03));
  EXPECT_TRUE(std::isnan(elastic.of(metric("residual_stretch", "final", "held"), "tension").value));
}

TEST(SolidMetrics, FindTheFrequencyOfAShearWave) {
  auto s = test::beam(0.0);
  auto& start = s.job.scene.bodies[0].velocity;
  start.kind = VelocityField::Kind::cosine;
  start.amplitude = {0, 0, 0.01};
  start.wave_vector = {10 * pi, 0, 0};
  test::set_times(s, 0.05, 100);
  Still f(s);
  const double w =
      0.9 * *make_reference(test::function("elastic_wave"), s.job, s.initial)->number("frequency");
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < f.s.initial.size(); ++i)
      frame.velocity[i] = {0.5, 0,
                           0.01 * std::cos(10 * pi * f.s.initial.position[i].x) * std::cos(w * frame.time)};
  EXPECT_NEAR(f.of(metric("frequency_squared", "final", "beam"), "elastic_wave").value, 0.81 - 1.0, 1e-9);
}

}  // namespace
}  // namespace tripoint
