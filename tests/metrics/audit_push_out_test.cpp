// SPDX-License-Identifier: BSD-3-Clause
// What engines do by places alone: a body that overlaps another one is pushed out, and no velocity shows it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fakes.hpp"
#include "frames.hpp"

namespace tripoint {
namespace {

using namespace test;

constexpr double push_step = 1e-3, interval = 2e-3;  // [s]

/// A block on a floor, so deep in it at the start. `make` shows it in frames of two steps, if not said
/// otherwise.
std::string on_floor(double depth, const std::function<void(BodyState&, double)>& make,
                     double step = push_step, const std::function<void(BodyState&)>& of_floor = {}) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  s.job.resolution.time_step = step;
  add_body(s, "floor", {{8, 8, 1}, 0.1, {-0.4, -0.4, -0.1}, 1.0}, {}, Motion::fixed);
  add_body(s, "block", {{4, 4, 2}, 0.1, {-0.2, -0.2, -depth}, 1.0}, {});
  set_times(s, 200 * interval, 200);
  Still still(s);
  for (auto& f : still.run.frames) {
    BodyState& b = f.bodies.back();
    if (f.time > 0.0) make(b, f.time);
    if (f.time > 0.0 && of_floor) of_floor(f.bodies.front());
    for (std::size_t i = 0; i < s.initial.size(); ++i) {
      const auto source = static_cast<std::size_t>(s.initial.source[i]);
      const BodyState& own = f.bodies[source];
      const Vec3 arm =
          rotate(own.orientation, s.initial.position[i] - s.job.bodies[source].properties.centre);
      f.position[i] = own.position + arm;
      f.velocity[i] = own.velocity + cross(own.angular_velocity, arm);
    }
  }
  return audit(s.job, s.initial, still.run);
}

/// The way of a body that is pushed out by so much, without a velocity.
auto pushed(double by) {
  return [by](BodyState& b, double t) { b.position.z += by * (1.0 - std::exp(-t / (2.0 * push_step))); };
}

TEST(AuditOfPushOut, LetsABodyOutOfWhatItOverlapsAtTheStartAndNoFarther) {
  constexpr double depth = 2e-4;
  EXPECT_EQ(on_floor(depth, pushed(depth)), "");
  EXPECT_NE(on_floor(depth, pushed(2.0 * depth)), "");
  EXPECT_NE(on_floor(0.0, pushed(depth)), "");
}

/// A hit at 1 m/s may sink a body by 1 mm in a step. It is pushed out in the frames after it.
TEST(AuditOfPushOut, LetsABodyOutAfterAHitByTheWayOfAStep) {
  constexpr double hit = 0.05, speed = 1.0;  // [s, m/s]
  const auto bounced = [&](double by) {
    return on_floor(0.0, [=](BodyState& b, double t) {
      b.velocity.x = t < hit ? 0.0 : speed;
      if (t >= hit) b.position.x += speed * (t - hit);
      if (t > hit + interval)
        b.position.z += by * (1.0 - std::exp((hit + interval - t) / (10.0 * push_step)));
    });
  };
  EXPECT_EQ(bounced(speed * push_step), "");
  EXPECT_NE(bounced(5.0 * speed * push_step), "");
}

/// A body that trembles as it lies turns to and fro within an interval, as Drake's does in steps of a tenth
/// of it. Its frames say nothing of a lag.
TEST(AuditOfPushOut, LetsASpinningBodyTremble) {
  const double rate[] = {-0.004, 0.0815, -0.133},
               turn[] = {0.0, -0.0132, -0.0218};  // of three frames [rad/s]
  const auto tremble = [&](BodyState& b, double t) {
    const auto n = std::lround(t / interval) % 3;
    b.angular_velocity = {rate[n], 0.0, 3.0};
    b.orientation =
        from_rotation_vector({interval * turn[n], 0.0, 0.0}) * from_rotation_vector({0.0, 0.0, 3.0 * t});
  };
  EXPECT_EQ(on_floor(0.0, tremble, 0.1 * interval), "");
}

void lies(BodyState&, double) {}

/// Contact hides a speed in one interval: gravity gives it and takes it. It does not in the mean.
TEST(AuditOfMean, ABodyThatLiesStatesNoSpeedInAllFrames) {
  const auto states = [&](double speed) {
    return on_floor(0.0, [=](BodyState& b, double) { b.velocity.x = speed; });
  };
  EXPECT_EQ(states(1e-3), "");
  EXPECT_NE(states(0.15), "");
  const auto trembles = on_floor(
      0.0, [](BodyState& b, double t) { b.velocity.z = std::lround(t / interval) % 2 == 0 ? 0.01 : -0.01; });
  EXPECT_EQ(trembles, "");
}

TEST(AuditOfGiven, AFixedBodyStays) {
  const auto with = [](const std::function<void(BodyState&)>& of_floor) {
    return on_floor(0.0, lies, push_step, of_floor);
  };
  EXPECT_EQ(with([](BodyState& b) { b.position.z -= 1e-5; }), "") << "digits of an output";
  EXPECT_EQ(with([](BodyState& b) { b.position.z -= 1e-3; }),
            "`floor` is fixed, and lies 0.001 m from its place at t = 0.002000 s");
  EXPECT_NE(with([](BodyState& b) {
              b.orientation = from_rotation_vector({0.01, 0, 0});
            }).find("`floor` is fixed, and is turned by 0.01 rad"),
            std::string::npos);
  EXPECT_NE(with([](BodyState& b) { b.velocity.x = 0.1; }).find("`floor` is fixed, and has a velocity"),
            std::string::npos);
  EXPECT_NE(with([](BodyState& b) {
              b.angular_velocity.z = 0.1;
            }).find("`floor` is fixed, and has an angular velocity"),
            std::string::npos);
}

}  // namespace
}  // namespace tripoint
