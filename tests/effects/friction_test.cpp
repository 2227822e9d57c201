// SPDX-License-Identifier: BSD-3-Clause
// Friction and restitution of pairs of materials: what each hit keeps, and what it takes.
#include <gtest/gtest.h>

#include "effects/fluid_lab.hpp"

namespace tripoint {
namespace {

/// Two blocks that hit each other off their centres, by a law of contact.
lab::Lab two_blocks(double friction, double restitution) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, 1000.0);
  lab.add({.name = "left", .corner = {-0.55, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {0.5, 0.2, 0.0}});
  lab.add({.name = "right", .corner = {0.05, 0.17, 0.03}, .count = {4, 4, 4}, .velocity = {-0.5, 0.0, 0.0}});
  const std::string name = lab.scene.materials.front().name;
  lab.scene.contact_laws.push_back({{name, name}, friction, restitution, {}});
  return lab;
}

double kinetic(const Ledger& ledger) { return ledger.energy.at("kinetic"); }

TEST(Friction, KeepsMomentumAndAngularMomentumToRoundOff) {
  lab::Lab lab = two_blocks(0.4, 0.5);
  Simulation start(lab.scene, lab.initial), end = lab.run(1.0);
  const Ledger before = start.ledger(), after = end.ledger();
  EXPECT_GT(after.energy.at("friction"), 0.1 * kinetic(before));
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-12 * 64.0);
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-12 * 64.0 * 0.5 * 0.4);
}

TEST(Friction, LessRestitutionLeavesLessMotion) {
  double before = kinetic(Simulation(two_blocks(0.0, 1.0).scene, two_blocks(0.0, 1.0).initial).ledger());
  for (const double restitution : {1.0, 0.7, 0.3, 0.0}) {
    const double left = kinetic(two_blocks(0.1, restitution).run(1.0).ledger());
    EXPECT_LT(left, before) << restitution;
    before = left;
  }
}

TEST(Friction, WithoutALawNothingRubs) {
  lab::Lab lab = two_blocks(0.0, 1.0);
  EXPECT_FALSE(lab.run(0.01).ledger().energy.contains("friction"));
}

TEST(Friction, HasTheSameBitsOnTwoThreads) {
  lab::Lab lab = two_blocks(0.4, 0.5);
  SimulationOptions two;
  two.threads = 2;
  Simulation one(lab.scene, lab.initial), other(lab.scene, lab.initial, two);
  one.advance_to(0.6);
  other.advance_to(0.6);
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_EQ(one.state().bodies[field::body_angular_velocity][b],
              other.state().bodies[field::body_angular_velocity][b]);
}

}  // namespace
}  // namespace tripoint
