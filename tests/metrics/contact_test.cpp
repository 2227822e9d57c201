// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/not_a_number.hpp"
#include "metrics/frames.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Still;

TEST(ContactMetrics, MeasureTheDepthOfOneBodyInAnother) {
  Still f(test::blocks());
  EXPECT_NEAR(f.stated(metric("overlap", "max")), 0.0, 1e-12);  // face to face, one spacing apart
  // The last two are inside: least distances alone would not tell
  for (const double depth : {0.03, 0.07, 0.13, 0.17}) {
    auto g = f;
    g.shift(g.run.frames.back(), 1, {-depth, 0, 0});
    EXPECT_NEAR(g.stated(metric("overlap", "final")), depth / 0.1, depth > 0.1 ? 0.3 : 1e-12)
        << depth;  // past the layer the way out is seen to 25 degrees
  }
}

TEST(ContactMetrics, SeeAContactThroughAPeriodicSeam) {
  auto scene = test::blocks();
  test::close_box(scene, {-0.4, -1, -1}, {0.4, 1, 9}, {true, false, false});
  Still f(scene);
  EXPECT_NEAR(f.stated(metric("overlap", "final")), 0.0, 1e-12);
  f.shift(f.run.frames.back(), 1, {0.05, 0, 0});
  EXPECT_NEAR(f.stated(metric("overlap", "final")), 0.5, 1e-12);
}

TEST(ContactMetrics, CompareOverlapsWithTheRunsOwnStart) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames) f.shift(frame, 1, {-0.02, 0, 0});
  f.shift(f.run.frames[3], 1, {-0.01, 0, 0});
  EXPECT_NEAR(f.of(metric("overlap", "drift"), "stated").value, 0.1, 1e-12);
}

TEST(ContactMetrics, CountNoOverlapWithinOneBody) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames) {
    frame.body.assign(frame.body.size(), 0);
    f.shift(frame, 1, {-0.07, 0, 0});
  }
  EXPECT_EQ(f.stated(metric("overlap", "max")), 0.0);
}

TEST(ContactMetrics, MeasureASeparation) {
  Still f(test::blocks());
  f.shift(f.run.frames.back(), 1, {0.3, 0.4, 0});
  EXPECT_NEAR(
      f.stated(metric("separation", "final", "left"), {{"other", std::string("right")}, {"value", 0.4}}),
      std::hypot(0.7, 0.4) - 0.4, 1e-12);
  // No value to compare with
  EXPECT_TRUE(std::isnan(f.stated(metric("separation", "final", "left"), {{"other", std::string("right")}})));
  EXPECT_THROW((void)f.stated(metric("separation", "final", "left"), {{"value", 0.4}}), InputError);
}

TEST(ContactMetrics, TellBodiesThatMoveAsOneFromThoseThatDoNot) {
  Still f(test::blocks());
  const Vec3 spin{0.3, -0.2, 0.5}, drift{1, 2, 3};
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.velocity.size(); ++i)
      frame.velocity[i] = drift + cross(spin, frame.position[i]);
  const auto choice = metric("relative_motion", "max", "left");
  EXPECT_NEAR(f.stated(choice, {{"other", std::string("right")}}), 0.0, 1e-12);
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 1) f.run.frames[2].velocity[i] += Vec3{0, 0.6, 0.8};
  EXPECT_NEAR(f.stated(choice, {{"other", std::string("right")}}), 1.0, 1e-12);
}

TEST(ContactMetrics, CountObjectsByWhatTouches) {
  Still f(test::blocks());
  EXPECT_EQ(f.stated(metric("object_count", "final"), {{"value", 1.0}}), 0.0);
  f.shift(f.run.frames.back(), 1, {0.06, 0, 0});  // 1.6 spacings: beyond the merging distance of 1.5
  EXPECT_EQ(f.stated(metric("object_count", "final"), {{"value", 1.0}}), 1.0);
  EXPECT_EQ(f.stated(metric("object_count", "final"), {{"value", 1.0}, {"phase", std::string("liquid")}}),
            0.0);
}

TEST(ContactMetrics, CountTheBodiesThatACaseStates) {
  Still f(test::blocks());
  EXPECT_EQ(f.stated(metric("body_count", "final"), {{"value", 2.0}}), 0.0);
  f.run.frames.back().bodies[1].position.x = not_a_number;
  f.run.frames.back().bodies[1].velocity.x = not_a_number;
  EXPECT_EQ(f.stated(metric("body_count", "final"), {{"value", 2.0}}), -1.0);
  // Between 0.75 and 1 s
  EXPECT_NEAR(f.stated(metric("event_time", "final"), {{"value", 0.7}}), 0.05, 1e-12);
}

}  // namespace
}  // namespace tripoint
