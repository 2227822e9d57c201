// SPDX-License-Identifier: BSD-3-Clause
// Lags and factors that all frames share, in free flight and in contact.
#include <gtest/gtest.h>

#include <functional>

#include "fakes.hpp"
#include "frames.hpp"

namespace tripoint {
namespace {

using namespace test;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// What the audit says of bodies whose rows are made anew in every frame but the first, particles with them.
std::string audited(Prepared& s, Trajectory run, double step,
                    const std::function<void(BodyState&, double)>& make) {
  s.job.resolution.time_step = step;
  for (auto& frame : run.frames) {
    if (frame.time > 0.0) make(frame.bodies.back(), frame.time);
    for (std::size_t i = 0; i < s.initial.size(); ++i) {
      const auto row = static_cast<std::size_t>(s.initial.body[i]);
      const BodyState& b = frame.bodies[row];
      const Vec3 arm = rotate(b.orientation, s.initial.position[i] - s.job.bodies[row].properties.centre);
      frame.position[i] = b.position + arm;
      frame.velocity[i] = b.velocity + cross(b.angular_velocity, arm);
    }
  }
  return audit(s.job, s.initial, run);
}

constexpr double top_step = 0.01;  // time step of the free top [s]

/// A free top in frames of four steps, with the spin of another time.
std::string top_with_spin_of(double earlier) {
  Trial t{block({1, 2, 3}, 10.0, 250), "torque_free"};
  for (auto& frame : t.run.frames) frame.bodies[0].mass = 1.0;
  return audited(t.s, t.run, top_step, [&](BodyState& b, double time) {
    b.angular_velocity = t.truth->at(time - earlier).bodies[0].angular_velocity;
  });
}

TEST(AuditOfLag, FindsASpinThatIsAStepOrHalfOfOneLate) {
  EXPECT_EQ(top_with_spin_of(0.0), "");
  EXPECT_TRUE(says(top_with_spin_of(top_step), "contradicts itself"));
  EXPECT_TRUE(says(top_with_spin_of(0.5 * top_step), "the turns of `block` are 0.5 steps ahead of"));
}

/// A scheme of first order is half a step behind, and does not keep the angular momentum.
TEST(AuditOfLag, LetsSemiImplicitEulerSpin) {
  Trial t{block({1, 2, 3}, 10.0, 250), "torque_free"};
  const auto& p = t.s.job.bodies[0].properties;
  for (auto& frame : t.run.frames) frame.bodies[0].mass = 1.0;
  Quaternion q;
  Vec3 w{1, 2, 3};
  const std::string why = audited(t.s, t.run, top_step, [&](BodyState& b, double) {
    for (int k = 0; k < 4; ++k) {
      const Quaternion axes = q * p.principal_axes;
      const Vec3 own = rotate_back(axes, w), &i = p.principal_inertia;
      const Vec3 L{i.x * own.x, i.y * own.y, i.z * own.z}, torque = cross(L, own);
      w = rotate(axes, own + top_step * Vec3{torque.x / i.x, torque.y / i.y, torque.z / i.z});
      q = from_rotation_vector(top_step * w) * q;
    }
    b.orientation = normalised(q);
    b.angular_velocity = w;
  });
  EXPECT_EQ(why, "");
}

constexpr double slide_step = 1e-3, slide_speed = 2.0,
                 slide_slope = -2.943;  // of the block that slides [s, m/s, m/s2]
constexpr double turn_slope = 20.0;     // of the block that is turned as it slides [rad/s2]

/// A block that slides and turns on a floor, as `make` shows the time, in frames of ten steps.
std::string sliding(const std::function<void(BodyState&, double)>& change) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  add_body(s, "floor", {{8, 8, 1}, 0.1, {-0.4, -0.4, -0.1}, 1.0}, {}, Motion::fixed);
  add_body(s, "block", {{4, 4, 2}, 0.1, {-0.2, -0.2, 0.0}, 1.0}, {});
  s.job.bodies[1].velocity = {slide_speed, 0, 0};
  for (std::size_t i = 0; i < s.initial.size(); ++i)
    if (s.initial.source[i] == 1) s.initial.velocity[i] = {slide_speed, 0, 0};
  set_times(s, 0.6, 60);
  Still still(s);
  const Vec3 start = still.run.frames[0].bodies[1].position;
  still.run.frames[0].bodies[1].velocity = {slide_speed, 0, 0};
  return audited(s, still.run, slide_step, [&](BodyState& b, double t) {
    b.position = start + Vec3{slide_speed * t + 0.5 * slide_slope * t * t, 0, 0};
    b.velocity = {slide_speed + slide_slope * t, 0, 0};
    b.orientation = from_rotation_vector({0, 0, 0.5 * turn_slope * t * t});
    b.angular_velocity = {0, 0, turn_slope * t};
    change(b, t);
  });
}

TEST(AuditOfLag, LetsSlidingOfFirstAndSecondOrderPass) {
  EXPECT_EQ(sliding([](BodyState&, double) {}), "");
  EXPECT_EQ(sliding([](BodyState& b, double t) {
              b.position.x += 0.5 * slide_slope * slide_step * t;
              b.orientation = from_rotation_vector({0, 0, 0.5 * turn_slope * t * (t + slide_step)});
            }),
            "");
}

TEST(AuditOfLag, FindsLagsFactorsAndJumpsInContact) {
  const std::pair<const char*, std::function<void(BodyState&, double)>> ways[] = {
      {"the places of `block` are 1 steps behind its velocities",
       [](BodyState& b, double t) { b.position.x -= slide_slope * slide_step * t; }},
      {"`block` moves otherwise than its velocity says from t = 0.000000",
       [](BodyState& b, double) { b.position.x -= slide_step * b.velocity.x; }},
      {"the places of `block` are 1 steps ahead of its velocities",
       [](BodyState& b, double) { b.velocity.x -= slide_slope * slide_step; }},
      {"the places of `block` change by 0.999", [](BodyState& b, double) { b.velocity *= 1.0005; }},
      {"the turns of `block` are 1 steps behind its angular velocities",
       [](BodyState& b, double t) {
         b.orientation = from_rotation_vector({0, 0, 0.5 * turn_slope * t * (t - 2 * slide_step)});
       }},
      {"the angular velocity of `block` leaves those before and after it",
       [](BodyState& b, double t) { b.angular_velocity *= std::abs(t - 0.5) < 1e-6 ? -1.0 : 1.0; }},
      {"the velocity of `block` leaves those before and after it",
       [](BodyState& b, double t) { b.velocity *= std::abs(t - 0.3) < 1e-6 ? -1.0 : 1.0; }}};
  for (const auto& [words, way] : ways)
    EXPECT_TRUE(says(sliding(way), words)) << words << ": " << sliding(way);
}

/// A block that is hit back and forth within two frames shows it by its places. Without them it is a fault.
TEST(AuditOfLag, LetsABlockInContactBeHitBackAndForth) {
  const auto hit = [](double shown) {
    return sliding([shown](BodyState& b, double t) {
      if (std::abs(t - 0.3) > 1e-6) return;
      b.velocity *= -1.0;
      b.position.x += shown;
    });
  };
  EXPECT_EQ(hit(-0.004), "");
  EXPECT_TRUE(says(hit(0.0), "the velocity of `block` leaves those before and after it"));
}

}  // namespace
}  // namespace tripoint
