// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "core/quaternion.hpp"

namespace tripoint {
namespace {

constexpr double round_off = 4e-16;

TEST(Quaternion, TurnsXToYByAQuarterTurnAboutZ) {
  const Vec3 v = rotate(from_rotation_vector({0.0, 0.0, std::numbers::pi / 2}), {1.0, 0.0, 0.0});
  EXPECT_NEAR(v.x, 0.0, round_off);
  EXPECT_NEAR(v.y, 1.0, round_off);
  EXPECT_NEAR(v.z, 0.0, round_off);
}

TEST(Quaternion, KeepsLengthsAndIsUndoneByItsConjugate) {
  const Quaternion q = from_rotation_vector({0.3, -1.1, 2.0});
  const Vec3 v{1.0, 2.0, -3.0};
  EXPECT_NEAR(norm(rotate(q, v)), norm(v), 8 * round_off);
  EXPECT_NEAR(norm(rotate_back(q, rotate(q, v)) - v), 0.0, 8 * round_off);
}

TEST(Quaternion, ProductAppliesTheRightFactorFirst) {
  const Quaternion a = from_rotation_vector({0.4, 0.0, 0.0}), b = from_rotation_vector({0.0, 0.7, 0.0});
  const Vec3 v{0.2, -0.5, 1.0};
  EXPECT_NEAR(norm(rotate(a * b, v) - rotate(a, rotate(b, v))), 0.0, 4 * round_off);
}

TEST(Quaternion, AngleBetweenIsBlindToTheSign) {
  const Quaternion q = from_rotation_vector({0.1, 0.2, 0.3});
  EXPECT_NEAR(angle_between(q, {-q.w, -q.x, -q.y, -q.z}), 0.0, 1e-15);
  // No loss at small angles
  EXPECT_NEAR(angle_between({}, from_rotation_vector({1e-9, 0.0, 0.0})), 1e-9, 1e-24);
}

TEST(Quaternion, SlerpGoesTheShorterWayAtConstantSpeed) {
  const Quaternion a, b = from_rotation_vector({0.0, 0.0, 1.2});
  EXPECT_NEAR(angle_between(a, slerp(a, {-b.w, -b.x, -b.y, -b.z}, 0.25)), 0.3, 4 * round_off);
}

}  // namespace
}  // namespace tripoint
