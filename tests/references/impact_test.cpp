// SPDX-License-Identifier: BSD-3-Clause
// Contact of bodies that have Coulomb's law and Newton's law of impact: each closed form against the laws
// that it comes from.
#include <gtest/gtest.h>

#include <cmath>

#include "references/scenes.hpp"
#include "validation/references/coulomb.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::Prepared;

constexpr double g = 9.81;

/// The motion again, by small steps of the laws themselves.
CoulombMotion::State stepped(const CoulombMotion::Plane& plane, const CoulombMotion::Contact& contact,
                             double v, double w, double time) {
  const int steps = 200000;
  const double dt = time / steps;
  CoulombMotion::State s{0.0, v, 0.0, w};
  for (int n = 0; n < steps; ++n) {
    const double slip = s.speed - (contact.share > 0.0 ? s.spin * contact.radius : 0.0),
                 // Friction that ends the slip in this step
        stop = -(slip / dt + plane.pull) / (1.0 + contact.share);
    const double friction = std::clamp(stop, -plane.grip, plane.grip);
    s.speed += dt * (plane.pull + friction);
    s.spin -= dt * friction * contact.share / contact.radius;
    s.way += dt * s.speed;
    s.angle += dt * s.spin;
  }
  return s;
}

TEST(Coulomb, MovesAsTheLawsDoStepByStep) {
  for (const double pull : {-2.0, 0.0, 1.5, 6.0})
    for (const double grip : {0.0, 1.0, 3.0})
      for (const CoulombMotion::Contact contact :
           {CoulombMotion::Contact{}, CoulombMotion::Contact{2.5, 0.2}})
        for (const auto& [v, w] :
             {std::pair{0.0, 0.0}, {2.0, 0.0}, {-1.0, 0.0}, {0.5, contact.share > 0.0 ? 20.0 : 0.0}}) {
          const auto exact = CoulombMotion({pull, grip}, contact, v, w).at(1.3),
                     seen = stepped({pull, grip}, contact, v, w, 1.3);
          EXPECT_NEAR(exact.way, seen.way, 2e-4)
              << "first order in a step of 6.5 us; pull " << pull << ", grip " << grip << ", share "
              << contact.share << ", v " << v;
          EXPECT_NEAR(exact.speed, seen.speed, 2e-4);
          EXPECT_NEAR(exact.spin, seen.spin, 2e-3);
          EXPECT_NEAR(exact.angle, seen.angle, 2e-3);
        }
}

TEST(Coulomb, HasTheTextbooksNumbers) {
  const CoulombMotion slide({0.0, 0.3 * g}, {}, 2.0, 0.0);
  EXPECT_NEAR(slide.at(5.0).way, 4.0 / (2.0 * 0.3 * g), 1e-15);
  EXPECT_EQ(slide.at(5.0).speed, 0.0);
  const CoulombMotion roll({0.0, 0.2 * g}, {2.5, 0.2}, 2.0, 0.0);  // a solid ball: m r^2/I = 5/2
  EXPECT_NEAR(roll.at(3.0).speed, 2.0 * 5.0 / 7.0, 1e-15);
  EXPECT_NEAR(roll.slip_ends(), 2.0 * 2.0 / (7.0 * 0.2 * g), 1e-15);
  const CoulombMotion down({g * 0.5, 0.8 * g * std::sqrt(0.75)}, {2.5, 0.2}, 0.0, 0.0);
  EXPECT_NEAR(down.at(1.0).speed, g * 0.5 * 5.0 / 7.0, 1e-14);
}

/// A box of 4 x 4 x 2 particles on a floor, gravity tilted by an angle about y.
Prepared on_slope(double angle, double friction) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {g * std::sin(angle), 0.0, -g * std::cos(angle)};
  s.job.settings["friction"] = friction;
  test::add_body(s, "block", {{4, 4, 2}, 0.1, {}, 4.0}, {});
  test::add_body(s, "floor", {{20, 4, 1}, 0.1, {-0.5, 0.0, -0.1}, 1.0}, {}, Motion::fixed);
  test::set_times(s, 1.0, 10);
  return s;
}

TEST(Sliding, TakesSlopeAndFrictionFromTheJob) {
  const double angle = test::pi / 6.0;
  const auto slips = on_slope(angle, 0.3), sticks = on_slope(angle, 0.6);
  const auto end = make_reference(test::function("sliding"), slips.job, slips.initial)->at(1.0);
  EXPECT_NEAR(end.bodies[0].velocity.x, g * (std::sin(angle) - 0.3 * std::cos(angle)), 1e-14);
  EXPECT_NEAR(end.bodies[0].position.x - 0.2, 0.5 * g * (std::sin(angle) - 0.3 * std::cos(angle)), 1e-14);
  EXPECT_EQ(
      make_reference(test::function("sliding"), sticks.job, sticks.initial)->at(1.0).bodies[0].velocity.x,
      0.0)
      << "tan 30 = 0.577 is below 0.6";
  const double steep = test::pi / 3.0;  // gravity points along the slope more than into it
  const auto falls = on_slope(steep, 0.3);
  EXPECT_NEAR(
      make_reference(test::function("sliding"), falls.job, falls.initial)->at(1.0).bodies[0].velocity.x,
      g * (std::sin(steep) - 0.3 * std::cos(steep)), 1e-14);
}

TEST(Sliding, RefusesWhatItsLawDoesNotHold) {
  const auto refused = [](auto change) {
    auto s = on_slope(0.2, 0.3);
    change(s);
    try {
      (void)make_reference(test::function("sliding"), s.job, s.initial);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused([](Prepared&) {}), "");
  EXPECT_NE(refused([](Prepared& s) {
              s.job.bodies[0].velocity = {0, 1, 0};
            }).find("one line"),
            std::string::npos);
  EXPECT_NE(refused([](Prepared& s) { s.job.settings["friction"] = 3.0; }).find("tip"), std::string::npos);
  EXPECT_NE(refused([](Prepared& s) { s.job.scene.bodies[0].shape.min.z += 0.01; }).find("touch"),
            std::string::npos);
}

/// A box that tumbles, 0.4 m above a smooth floor.
Prepared tumbling(double restitution, const Vec3& spin) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0.0, 0.0, -g};
  s.job.settings["restitution"] = restitution;
  test::add_body(s, "block", {{6, 4, 2}, 0.1, {0.0, 0.0, 0.4}, 4.0}, {{0.3, 0.0, 0.0}, spin});
  test::add_body(s, "floor", {{20, 20, 1}, 0.1, {-1.0, -1.0, -0.1}, 1.0}, {}, Motion::fixed);
  test::set_times(s, 1.0, 10);
  return s;
}

double energy(const Prepared& s, const BodyState& b) {
  const auto& p = s.job.bodies[0].properties;
  const Vec3 w = rotate_back(b.orientation * p.principal_axes, b.angular_velocity);
  return 0.5 * p.mass * dot(b.velocity, b.velocity) +
         0.5 * (p.principal_inertia.x * w.x * w.x + p.principal_inertia.y * w.y * w.y +
                p.principal_inertia.z * w.z * w.z) +
         p.mass * g * b.position.z;
}

Vec3 spin_momentum(const Prepared& s, const BodyState& b) {
  const auto& p = s.job.bodies[0].properties;
  const Vec3 w = rotate_back(b.orientation * p.principal_axes, b.angular_velocity), I = p.principal_inertia;
  return rotate(b.orientation * p.principal_axes, Vec3{I.x * w.x, I.y * w.y, I.z * w.z});
}

/// Corners that are at the floor, from the centre.
std::vector<Vec3> touching(const Prepared& s, const BodyState& b) {
  std::vector<Vec3> arms;
  const Shape& shape = s.job.scene.bodies[0].shape;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner{k & 1 ? shape.max.x : shape.min.x, k & 2 ? shape.max.y : shape.min.y,
                      k & 4 ? shape.max.z : shape.min.z};
    const Vec3 arm = rotate(b.orientation, corner - s.job.bodies[0].properties.centre);
    if (std::abs(b.position.z + arm.z) < 1e-6) arms.push_back(arm);
  }
  return arms;
}

/// Impulse along the normal at the corners that touch, Newton's law there, and nothing else: these fix the
/// motion after the hit.
void expect_newtons_impact(double restitution, const Vec3& spin, std::size_t corners) {
  const auto s = tumbling(restitution, spin);
  const auto reference = make_reference(test::function("landing"), s.job, s.initial);
  const double t = reference->number("event_time").value(), h = 1e-9;
  const auto before = reference->at(t - h).bodies[0], after = reference->at(t + h).bodies[0];
  const auto arms = touching(s, after);
  ASSERT_EQ(arms.size(), corners);
  const Vec3 dp = s.job.bodies[0].properties.mass * (after.velocity - before.velocity),
             dL = spin_momentum(s, after) - spin_momentum(s, before);
  EXPECT_LT(std::hypot(dp.x, dp.y), 1e-6 * dp.z) << "no friction: no impulse along the floor";
  EXPECT_NEAR(dL.z, 0.0, 1e-6 * dp.z) << "no torque about the normal";
  Vec3 mean;
  for (const Vec3& arm : arms) mean += (1.0 / static_cast<double>(arms.size())) * arm;
  if (corners == 1) {
    EXPECT_LT(norm(dL - cross(mean, dp)), 1e-6 * dp.z);
  }
  for (const Vec3& arm : arms) {
    const double in = before.velocity.z + cross(before.angular_velocity, arm).z,
                 out = after.velocity.z + cross(after.angular_velocity, arm).z;
    EXPECT_LT(in, -1.0);
    EXPECT_NEAR(out, -restitution * in, 1e-6);
  }
  if (restitution == 1.0) {
    EXPECT_NEAR(energy(s, after), energy(s, before), 1e-6 * energy(s, before));
  }
  EXPECT_LT(energy(s, after), energy(s, before) * (1.0 + 1e-6));
  EXPECT_TRUE(std::isnan(reference->at(reference->number("next_touch").value() + 0.01).bodies[0].position.z))
      << "nothing is known after the second touch";
}

TEST(Landing, TurnsABoxByOneImpulseAtTheCorner) {
  for (const double e : {1.0, 0.7, 0.3}) expect_newtons_impact(e, {2.0, 3.0, 1.0}, 1);
}
TEST(Landing, TurnsABoxByTwoImpulsesAlongTheEdge) {
  for (const double e : {1.0, 0.7}) expect_newtons_impact(e, {2.0, 0.0, 0.0}, 2);
}
TEST(Landing, RefusesAFace) {
  const auto s = tumbling(1.0, {});
  EXPECT_THROW((void)make_reference(test::function("landing"), s.job, s.initial), InputError);
}

TEST(Bouncing, TakesTheRestitutionOfAllEngines) {
  auto s = tumbling(0.5, {});
  s.job.bodies[0].velocity = {};
  const auto reference = make_reference(test::function("bouncing"), s.job, s.initial);
  const double t = reference->number("touch_time").value();
  EXPECT_NEAR(reference->at(t + 1e-6).bodies[0].velocity.z, 0.5 * g * t, 1e-4);
}

}  // namespace
}  // namespace tripoint
