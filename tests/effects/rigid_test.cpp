// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effects/lab.hpp"
#include "scene/ledger_entry.hpp"

namespace tripoint {
namespace {

const Vec3 g{0.0, 0.0, -9.81};

TEST(RigidBody, FliesOnTheExactParabolaWhileItSpins) {
  lab::Lab lab(0.1);
  lab.scene.gravity = g;
  lab.scene.time_step = 0.01;
  lab.add({.count = {4, 4, 4}, .velocity = {1.0, 0.0, 5.0}, .angular_velocity = {1.87, 3.74, 5.61}});
  const Vec3 start{0.15, 0.15, 0.15};
  const Simulation s = lab.run(1.0);
  const Vec3 expected = start + Vec3{1.0, 0.0, 5.0} + 0.5 * g;
  EXPECT_NEAR(norm(s.state().bodies[field::body_centre][0] - expected), 0.0,
              1e-13);  // kick-drift-kick is exact for constant forces
  EXPECT_NEAR(norm(s.state().bodies[field::body_velocity][0] - (Vec3{1.0, 0.0, 5.0} + g)), 0.0, 1e-13);
}

TEST(RigidBody, AConstantForceAtItsCentreAddsFOverMToGravity) {
  lab::Lab lab(0.1);
  lab.scene.gravity = g;
  lab.scene.time_step = 0.01;
  lab.add({.name = "pushed",
           .count = {4, 4, 4},
           .velocity = {1.0, 0.0, 5.0},
           .angular_velocity = {1.87, 3.74, 5.61}});
  const Vec3 force{3.0, -200.0, 40.0};
  lab.scene.forces.push_back({"pushed", force, {}, {}, 0.0, {}, {}});
  const Simulation s = lab.run(1.0);
  const Vec3 a = g + force / s.state().bodies[field::body_mass][0];
  EXPECT_NEAR(norm(s.state().bodies[field::body_centre][0] - (Vec3{1.15, 0.15, 5.15} + 0.5 * a)), 0.0, 1e-12);
  EXPECT_NEAR(norm(s.state().bodies[field::body_angular_velocity][0]), norm(Vec3{1.87, 3.74, 5.61}), 1e-12);
}

/// A force at a point swings the body as a pendulum; its potential is -F . r_point.
double energy_drift_under_a_force_at_a_corner(double dt) {
  lab::Lab lab = lab::asymmetric_block({0.2, 0.1, 0.0});
  lab.scene.time_step = dt;
  lab.scene.bodies[0].name = "swung";
  lab.scene.forces.push_back({"swung", {0.0, 0.3, -1.0}, Vec3{0.5, 0.3, 0.2}, {}, 0.0, {}, {}});
  Simulation s(lab.scene, lab.initial, {.threads = 1});
  const auto energy = [&] {
    const Ledger now = s.ledger();
    return now.energy.at(ledger_entry::kinetic) + now.energy.at(ledger_entry::potential);
  };
  const double before = energy();
  double most = 0.0;
  for (int n = 1; n <= 20; ++n) {
    s.advance_to(0.1 * n);
    most = std::max(most, std::abs(energy() - before));
  }
  EXPECT_GT(norm(s.state().bodies[field::body_angular_velocity][0]), 1.0) << "it turns the body";
  return most;
}

TEST(RigidBody, AForceOffTheCentreKeepsKineticAndPotentialEnergyToSecondOrder) {
  const double coarse = energy_drift_under_a_force_at_a_corner(0.01),
               fine = energy_drift_under_a_force_at_a_corner(0.005);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(RigidBody, StartedAsThePaperDoesLagsByHalfAStepOfGravity) {
  lab::Lab lab(0.1, Mode::paper);
  lab.scene.gravity = g;
  lab.scene.time_step = 0.01;
  lab.add({.count = {2, 2, 2}});
  const Simulation s = lab.run(1.0);
  const double exact = 0.05 - 0.5 * 9.81;
  EXPECT_NEAR(s.state().bodies[field::body_centre][0].z - exact, 9.81 * 0.01 / 2.0, 1e-12);  // g dt T/2
}

TEST(RigidBody, KeepsItsShapeOverALongSpin) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.time_step = 0.01;
  Simulation s = lab.run(100.0);
  const auto x = positions(s.state().particles);
  double worst = 0.0;
  for (std::size_t a = 0; a < lab.initial.size(); a += 7) {
    for (std::size_t b = 0; b < a; b += 11) {
      const double before = norm(lab.initial.position[a] - lab.initial.position[b]);
      worst = std::max(worst, std::abs(norm(x.at(a) - x.at(b)) / before - 1.0));
    }
  }
  EXPECT_LT(worst, 1e-14 * 10);  // placed from reference positions, not integrated
  const Ledger now = s.ledger();
  EXPECT_GT(angle_between(s.state().bodies[field::body_orientation][0], {}), 0.1);
  Simulation before(lab.scene, lab.initial);
  EXPECT_NEAR(norm(now.angular_momentum - before.ledger().angular_momentum), 0.0, 1e-14);
}

TEST(RigidBody, StartsWithTheIdentityWhateverItsPrincipalAxes) {
  lab::Lab lab(0.1);
  lab.add_points({.angular_velocity = {0.3, -0.2, 1.0}},
                 {{0, 0, 0}, {0.3, 0.3, 0}, {-0.2, 0.2, 0.1}, {0.1, -0.1, 0.4}, {0.2, 0.3, -0.1}}, 0.1);
  const Simulation s(lab.scene, lab.initial);
  EXPECT_EQ(s.state().bodies[field::body_orientation][0], Quaternion{});
  EXPECT_NEAR(norm(s.state().bodies[field::body_angular_velocity][0] - Vec3{0.3, -0.2, 1.0}), 0.0, 1e-14);
}

TEST(RigidBody, PrescribedIsWhereItsKeyframesSay) {
  lab::Lab lab(0.1);
  lab.add({.count = {3, 3, 3}, .motion = Motion::prescribed});
  auto& frames = lab.scene.bodies[0].keyframes;
  frames = {{0.0, {0.1, 0.1, 0.1}, {}}, {1.0, {1.1, 0.1, 0.1}, from_rotation_vector({0.0, 0.0, 1.0})}};
  const Simulation s = lab.run(0.5);
  const Columns& b = s.state().bodies;
  EXPECT_NEAR(norm(b[field::body_centre][0] - Vec3{0.6, 0.1, 0.1}), 0.0, 1e-14);
  EXPECT_NEAR(norm(b[field::body_velocity][0] - Vec3{1.0, 0.0, 0.0}), 0.0, 1e-14);
  EXPECT_NEAR(norm(b[field::body_angular_velocity][0] - Vec3{0.0, 0.0, 1.0}), 0.0, 1e-14);
  // a corner member: its place turned by half a radian, its velocity v + omega x r
  const Vec3 lever =
      rotate(from_rotation_vector({0.0, 0.0, 0.5}), lab.initial.position[0] - Vec3{0.1, 0.1, 0.1});
  const auto x = positions(s.state().particles), v = velocities(s.state().particles);
  EXPECT_NEAR(norm(x.at(0) - (Vec3{0.6, 0.1, 0.1} + lever)), 0.0, 1e-14);
  EXPECT_NEAR(norm(v.at(0) - (Vec3{1.0, 0.0, 0.0} + cross({0.0, 0.0, 1.0}, lever))), 0.0, 1e-14);
}

TEST(RigidBody, ReleasedFliesOnWithTheVelocityThatItHad) {
  lab::Lab lab(0.1);
  lab.scene.time_step = 0.01;
  lab.add({.count = {3, 3, 3},
           .motion = Motion::prescribed,
           .velocity = {2.0, 0.0, 0.0},
           .angular_velocity = {0.0, 0.0, 1.0}});
  Event release;
  release.kind = Event::Kind::release;
  release.time = 0.3;
  release.bodies = {"block"};
  lab.scene.events.push_back(release);
  const Simulation s = lab.run(1.0);
  EXPECT_NEAR(norm(s.state().bodies[field::body_centre][0] - Vec3{2.1, 0.1, 0.1}), 0.0, 1e-13);
  EXPECT_NEAR(norm(s.state().bodies[field::body_angular_velocity][0] - Vec3{0.0, 0.0, 1.0}), 0.0, 1e-13);
}

TEST(RigidBody, HeldStandsStillAndFallsAfterwards) {
  lab::Lab lab(0.1);
  lab.scene.gravity = g;
  lab.scene.time_step = 0.01;
  lab.add({.count = {2, 2, 2}});
  Event hold;
  hold.kind = Event::Kind::hold;
  hold.time = 0.0;
  hold.until = 0.5;
  hold.bodies = {"block"};
  lab.scene.events.push_back(hold);
  const Simulation s = lab.run(1.0);
  EXPECT_NEAR(s.state().bodies[field::body_centre][0].z, 0.05 - 0.5 * 9.81 * 0.25, 1e-13);
}

/// Bodies whose inertia tensor is singular: nothing may blow up, and L is kept.
struct Thin : testing::TestWithParam<std::vector<Vec3>> {};
TEST_P(Thin, SpinsWithoutBlowingUp) {
  lab::Lab lab(0.1);
  lab.scene.time_step = 0.01;
  lab.scene.gravity = g;
  lab.add_points({.angular_velocity = {1.0, 2.0, 3.0}}, GetParam(), 0.1);
  Simulation s(lab.scene, lab.initial);
  const Vec3 L = s.state().bodies[field::body_angular_momentum][0];
  s.advance_to(5.0);
  EXPECT_EQ(s.state().bodies[field::body_angular_momentum][0], L);
  EXPECT_LT(norm(s.state().bodies[field::body_angular_velocity][0]), 6.0);
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    EXPECT_TRUE(finite(positions(s.state().particles).at(i)));
}
std::vector<Vec3> line(int count, double offset) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
    points.push_back(0.1 * k * Vec3{0.6, 0.48, 0.64} + (k % 2 ? Vec3{0.0, 0.0, offset} : Vec3{}));
  return points;
}
INSTANTIATE_TEST_SUITE_P(
    Bodies, Thin,
    testing::Values(line(1, 0.0), line(2, 0.0), line(3, 0.0), line(5, 0.0), line(5, 1e-9), line(5, 1e-5),
                    line(5, 1e-3), std::vector<Vec3>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}}));

TEST(RigidBody, ThroughAPeriodicBoxTurnsAboutThatAxisOnly) {
  lab::Lab lab(0.1);
  lab.make_periodic({false, true, false}, {0.0, 0.0, 0.0}, {4, 6, 4});
  lab.scene.time_step = 0.01;
  lab.add({.count = {4, 6, 4}, .velocity = {0.0, 1.0, 0.0}, .angular_velocity = {0.0, 2.0, 0.0}});
  const Simulation s = lab.run(1.0);
  EXPECT_NEAR(
      angle_between(s.state().bodies[field::body_orientation][0], from_rotation_vector({0.0, 2.0, 0.0})), 0.0,
      1e-12);
  EXPECT_NEAR(s.state().bodies[field::body_centre][0].y, 1.25, 1e-13);

  lab.initial = {};
  lab.scene.bodies.clear();
  lab.add({.name = "beam", .count = {4, 6, 4}, .angular_velocity = {0.5, 2.0, 0.0}});
  try {
    const Simulation refused(lab.scene, lab.initial);
    FAIL() << "it would turn out of its own images";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("beam"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tripoint
