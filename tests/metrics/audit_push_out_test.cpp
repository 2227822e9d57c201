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
                     double step = push_step) {
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
    for (std::size_t i = 0; i < s.initial.size(); ++i)
      if (s.initial.source[i] == 1) {
        const Vec3 arm = rotate(b.orientation, s.initial.position[i] - s.job.bodies[1].properties.centre);
        f.position[i] = b.position + arm;
        f.velocity[i] = b.velocity + cross(b.angular_velocity, arm);
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

}  // namespace
}  // namespace tripoint
