// SPDX-License-Identifier: BSD-3-Clause
// Balls that hit walls and each other: each hit against the laws of momentum, restitution and friction.
#include <gtest/gtest.h>

#include <cmath>

#include "references/scenes.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::Prepared;

/// Adds a ball whose particles fill its enclosing cube: its moment is m (2 R)^2/6 (1 - 1/n^2), as the job
/// says.
void add_ball(Prepared& s, const std::string& name, const Vec3& centre, double mass,
              const test::Spin& motion) {
  test::add_body(s, name, {{4, 4, 4}, 0.05, centre - Vec3{0.1, 0.1, 0.1}, mass}, motion);
  Shape& shape = s.job.scene.bodies.back().shape;
  shape = {};
  shape.kind = Shape::Kind::sphere;
  shape.centre = centre;
  shape.radius = 0.1;
}

Prepared two_balls(double restitution, double friction, const Vec3& aside = {}) {
  Prepared s;
  s.job.scene.spacing = 0.05;
  s.job.settings["restitution"] = restitution;
  s.job.settings["friction"] = friction;
  add_ball(s, "heavy", {-0.5, 0.0, 0.0}, 2.0, {{1.5, 0.0, 0.0}, {}});
  add_ball(s, "light", Vec3{0.5, 0.0, 0.0} + aside, 1.0, {{-0.5, 0.0, 0.0}, {}});
  test::set_times(s, 1.0, 10);
  return s;
}

TEST(BallHits, KeepMomentumAndGiveBackTheRestitutionOfTheApproach) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const auto s = two_balls(e, 0.0);
    const auto truth = make_reference(test::function("ball_hits"), s.job, s.initial);
    const auto end = truth->at(1.0).bodies;
    EXPECT_NEAR(*truth->number("touch_time"), 0.4, 1e-15) << "a gap of 0.8 m at 2 m/s";
    EXPECT_NEAR(2.0 * end[0].velocity.x + end[1].velocity.x, 2.5, 1e-14);
    EXPECT_NEAR(end[1].velocity.x - end[0].velocity.x, 2.0 * e, 1e-14);
    EXPECT_NEAR(end[0].position.x, -0.5 + 0.4 * 1.5 + 0.6 * end[0].velocity.x, 1e-14);
  }
}

TEST(BallHits, KeepAngularMomentumOfAnOffCentreHitWithFriction) {
  const auto s = two_balls(0.7, 0.2, {0.0, 0.08, 0.05});
  const auto truth = make_reference(test::function("ball_hits"), s.job, s.initial);
  const auto sum = [&](double t) {
    Vec3 L;
    const auto bodies = truth->at(t).bodies;
    for (std::size_t b = 0; b < 2; ++b)
      L += bodies[b].mass * cross(bodies[b].position, bodies[b].velocity) +
           s.job.bodies[b].properties.principal_inertia[0] * bodies[b].angular_velocity;
    return L;
  };
  EXPECT_GT(norm(truth->at(1.0).bodies[1].angular_velocity), 0.1);
  EXPECT_NEAR(norm(sum(1.0) - sum(0.0)), 0.0, 1e-14);
}

/// A ball that falls on the wall x >= 0.3 at an angle from its normal, with a speed of 1 m/s.
Prepared oblique(double angle, double restitution, double friction) {
  Prepared s;
  s.job.scene.spacing = 0.05;
  s.job.settings["restitution"] = restitution;
  s.job.settings["friction"] = friction;
  add_ball(s, "ball", {0.0, 0.0, 0.0}, 1.0, {{std::cos(angle), std::sin(angle), 0.0}, {}});
  test::add_body(s, "wall", {{4, 80, 40}, 0.05, {0.3, -1.0, -1.0}, 1.0}, {}, Motion::fixed);
  test::set_times(s, 1.0, 10);
  return s;
}

TEST(BallHits, SlideByFrictionAtAFlatAngleAndRollAtASteepOne) {
  const double e = 0.98, mu = 0.092, flat = 1.05, steep = 0.2;
  const auto slides = oblique(flat, e, mu), rolls = oblique(steep, e, mu);
  const auto after = [](const Prepared& s) {
    return make_reference(test::function("ball_hits"), s.job, s.initial)->at(1.0).bodies[0];
  };
  const double moment = slides.job.bodies[0].properties.principal_inertia[0];  // of 1 kg
  const auto a = after(slides), b = after(rolls);
  EXPECT_NEAR(a.velocity.x, -e * std::cos(flat), 1e-14);
  EXPECT_NEAR(a.velocity.y / std::sin(flat), 1.0 - mu * (1.0 + e) / std::tan(flat), 1e-14);
  EXPECT_NEAR(norm(a.angular_velocity), 0.1 * mu * (1.0 + e) * std::cos(flat) / moment, 1e-13);
  EXPECT_NEAR(b.velocity.y / std::sin(steep), 1.0 / (1.0 + moment / 0.01), 1e-14)
      << "it rolls: 5/7 of a solid ball";
  EXPECT_NEAR(norm(b.angular_velocity) * 0.1, b.velocity.y, 1e-14);
}

TEST(BallHits, RefuseWhatTheirLawsDoNotHold) {
  const auto refused = [](auto change) {
    auto s = oblique(0.5, 0.5, 0.1);
    change(s);
    try {
      (void)make_reference(test::function("ball_hits"), s.job, s.initial);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused([](Prepared&) {}), "");
  EXPECT_NE(refused([](Prepared& s) {
              s.job.scene.gravity = {0, 0, -9.81};
            }).find("without gravity"),
            std::string::npos);
  EXPECT_NE(refused([](Prepared& s) { s.job.scene.bodies[0].shape.kind = Shape::Kind::box; }).find("neither"),
            std::string::npos);
  EXPECT_NE(refused([](Prepared& s) { s.job.settings["restitution"] = 1.5; }).find("from 0 to 1"),
            std::string::npos);
  EXPECT_NE(
      refused([](Prepared& s) { s.job.bodies[0].properties.principal_inertia[2] *= 1.1; }).find("differ"),
      std::string::npos);
}

}  // namespace
}  // namespace tripoint
