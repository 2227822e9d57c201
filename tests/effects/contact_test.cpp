// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/fluid_lab.hpp"

namespace tripoint {
namespace {

const Vec3& velocity_of(const Simulation& s, std::size_t body) {
  return s.state().bodies[field::body_velocity][body];
}

lab::Lab two_blocks(double stiffness, double speed, double offset) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, stiffness);
  lab.add({.name = "left", .corner = {-0.55, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {speed, 0.0, 0.0}});
  lab.add(
      {.name = "right", .corner = {0.05, offset, 0.0}, .count = {4, 4, 4}, .velocity = {-speed, 0.0, 0.0}});
  return lab;
}

/// Prototypes: energy to 1.5e-4 at k = 1e3 and dt = 1e-3.
TEST(HeadOn, EqualBlocksBounceWithTheirEnergyToOneInAThousand) {
  lab::Lab lab = two_blocks(1000.0, 0.5, 0.0);
  lab.scene.time_step = 1e-3;
  const Simulation s = lab.run(1.0);
  EXPECT_LT(velocity_of(s, 0).x, 0.0);
  const double kinetic =
      dot(velocity_of(s, 0), velocity_of(s, 0)) + dot(velocity_of(s, 1), velocity_of(s, 1));
  EXPECT_NEAR(kinetic / (2.0 * 0.25), 1.0, 1e-3);
  EXPECT_NEAR(velocity_of(s, 0).x + velocity_of(s, 1).x, 0.0, 1e-13);
}

TEST(Oblique, BlocksKeepMomentumAndAngularMomentumToRoundOff) {
  lab::Lab lab = two_blocks(1000.0, 0.5, 0.17);
  Simulation start(lab.scene, lab.initial), end = lab.run(1.0);
  const Ledger before = start.ledger(), after = end.ledger();
  EXPECT_GT(norm(end.state().bodies[field::body_angular_velocity][0]), 0.1);
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-13 * 64.0);
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-12 * 64.0 * 0.5 * 0.4);
}

TEST(Contact, DoesNotHoldBodiesTogetherWhereItIsClamped) {
  lab::Lab lab = two_blocks(1000.0, 0.0, 0.0);  // 0.2 dx farther apart than touching
  for (std::size_t i = 0; i < 64; ++i) lab.initial.position[i].x += 0.18;
  const Simulation s = lab.run(0.5);
  EXPECT_LE(velocity_of(s, 0).x, 0.0);
}

}  // namespace
}  // namespace tripoint
