// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "known.hpp"

namespace tripoint::test {
namespace {

/// Two blocks that a joint of this kind holds at the origin, with axes y and x.
Still tied(Joint::Kind kind) {
  Still f = still_blocks();
  Joint j;
  j.name = "j";
  j.kind = kind;
  j.bodies = {f.s.job.bodies[0].name, f.s.job.bodies[1].name};
  j.axis = Vec3{0, 1, 0};
  j.other_axis = Vec3{1, 0, 0};
  if (kind == Joint::Kind::distance) j.other_point = Vec3{1, 0, 0};
  f.s.job.scene.joints = {j};
  return f;
}

BodyState& last(Still& f, std::size_t body) { return f.run.frames.back().bodies.at(body); }

double found(const Still& f, const std::string& quantity) {
  return value(f, metric(quantity, "final")).value;
}

TEST(JointMetrics, GapIsTheDistanceOfBothPoints) {
  Still f = tied(Joint::Kind::ball);
  EXPECT_NEAR(found(f, "joint_gap"), 0.0, 1e-15);
  last(f, 0).position += Vec3{0.03, 0.04, 0};
  EXPECT_NEAR(found(f, "joint_gap"), 0.05, 1e-15);
}

TEST(JointMetrics, GapOfASliderIsAcrossItsAxisAndOfADistanceBeyondItsLength) {
  Still slides = tied(Joint::Kind::slider);
  last(slides, 0).position += Vec3{0.03, 0.4, 0};
  EXPECT_NEAR(found(slides, "joint_gap"), 0.03, 1e-15);
  Still apart = tied(Joint::Kind::distance);
  last(apart, 1).position += Vec3{0.2, 0, 0};
  EXPECT_NEAR(std::abs(found(apart, "joint_gap")), 0.2, 1e-15);
}

/// A turn about the axis of a hinge is free, one across it is not.
TEST(JointMetrics, MisalignmentIsWhatAJointHolds) {
  const auto turned = [](Joint::Kind kind, const Vec3& by) {
    Still f = tied(kind);
    last(f, 0).orientation = from_rotation_vector(by);
    return std::abs(found(f, "joint_misalignment"));
  };
  EXPECT_NEAR(turned(Joint::Kind::hinge, {0, 0.3, 0}), 0.0, 1e-12);
  EXPECT_NEAR(turned(Joint::Kind::hinge, {0.2, 0, 0}), 0.2, 1e-12);
  EXPECT_NEAR(turned(Joint::Kind::fixed, {0, 0.3, 0}), 0.3, 1e-12);
  EXPECT_NEAR(turned(Joint::Kind::slider, {0.1, 0, 0}), 0.1, 1e-12);
  EXPECT_NEAR(turned(Joint::Kind::universal, {0, 0, 0.1}), 0.1, 1e-12);
  EXPECT_NEAR(turned(Joint::Kind::universal, {0.1, 0, 0}), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(turned(Joint::Kind::ball, {0.1, 0, 0}))) << "a ball holds no angle";
}

TEST(JointMetrics, CoordinateIsTheAngleAboutTheAxisOrTheWayAlongIt) {
  Still f = tied(Joint::Kind::hinge);
  last(f, 0).orientation = from_rotation_vector({0, 0.3, 0});
  EXPECT_NEAR(found(f, "joint_coordinate"), 0.3, 1e-12);
  last(f, 0).orientation = from_rotation_vector({0, -3.1, 0});
  EXPECT_NEAR(std::abs(found(f, "joint_coordinate")), 3.1, 1e-12);
  Still slides = tied(Joint::Kind::slider);
  last(slides, 0).position += Vec3{0, 0.4, 0};
  EXPECT_NEAR(found(slides, "joint_coordinate"), 0.4, 1e-15);
}

}  // namespace
}  // namespace tripoint::test
