// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "scene/motion.hpp"

namespace tripoint {
namespace {

using std::numbers::pi;
const Quaternion quarter_about_z = from_rotation_vector({0, 0, pi / 2});
const std::vector<Keyframe> frames{
    {0.0, {0, 0, 0}, {}}, {2.0, {4, 0, 0}, quarter_about_z}, {3.0, {4, 1, 0}, quarter_about_z}};

TEST(PrescribedMotion, RunsStraightAndTurnsEvenlyBetweenKeyframes) {
  const auto p = prescribed_state(frames, {}, {}, {}, 1.0);
  EXPECT_EQ(p.position, (Vec3{2, 0, 0}));
  EXPECT_EQ(p.velocity, (Vec3{2, 0, 0}));
  EXPECT_NEAR(p.angular_velocity.z, pi / 4, 1e-15);
  EXPECT_NEAR(angle_between(p.rotation, from_rotation_vector({0, 0, pi / 4})), 0.0, 1e-15);
}

TEST(PrescribedMotion, HasTheDerivativeOfItsPlaceAsVelocity) {
  const Quaternion tilted = normalised({0.9, 0.2, -0.3, 0.1});
  const std::vector<Keyframe> two{{0.5, {1, 2, 3}, tilted},
                                  {2.5, {2, 0, 1}, normalised({0.5, 0.6, 0.1, -0.4})}};
  const double t = 1.3, e = 1e-5;
  const auto a = prescribed_state(two, {}, {}, {}, t - e), b = prescribed_state(two, {}, {}, {}, t + e),
             p = prescribed_state(two, {}, {}, {}, t);
  EXPECT_LT(norm((b.position - a.position) / (2 * e) - p.velocity), 1e-9);
  const Quaternion d = b.rotation * conjugate(a.rotation);  // world frame
  // Central difference: error e^2 and round-off/e
  EXPECT_LT(norm(Vec3{d.x, d.y, d.z} / e - p.angular_velocity), 1e-8);
}

TEST(PrescribedMotion, RestsBeforeTheFirstAndAfterTheLastKeyframe) {
  const auto before = prescribed_state({{1.0, {1, 1, 1}, {}}, {2.0, {2, 1, 1}, {}}}, {}, {}, {}, 0.5);
  EXPECT_EQ(before.position, (Vec3{1, 1, 1}));
  EXPECT_EQ(before.velocity, (Vec3{}));
  const auto after = prescribed_state(frames, {}, {}, {}, 9.0);
  EXPECT_EQ(after.position, (Vec3{4, 1, 0}));
  EXPECT_EQ(after.velocity, (Vec3{}));
  EXPECT_EQ(prescribed_state(frames, {}, {}, {}, 3.0).velocity, (Vec3{0, 1, 0}))
      << "the last keyframe's own time belongs to its piece";
}

TEST(PrescribedMotion, WithoutKeyframesGoesOnForEver) {
  const auto p = prescribed_state({}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, 10.0);
  EXPECT_EQ(p.position, (Vec3{1, 20, 0}));
  EXPECT_EQ(p.velocity, (Vec3{0, 2, 0}));
  EXPECT_EQ(p.angular_velocity, (Vec3{0, 0, 3}));
  EXPECT_NEAR(angle_between(p.rotation, from_rotation_vector({0, 0, 30.0})), 0.0, 1e-14);
}

}  // namespace
}  // namespace tripoint
