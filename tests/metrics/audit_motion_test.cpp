// SPDX-License-Identifier: BSD-3-Clause
// Motion that contradicts itself: places against velocities, turns against angular velocities, gauges against
// particles.
#include <gtest/gtest.h>

#include <functional>

#include "fakes.hpp"
#include "frames.hpp"

namespace tripoint {
namespace {

using namespace test;

constexpr double step = 0.01;  // [s]

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// Rows of a run's bodies, with their particles: placed and moved rigidly.
void place_particles(Trial& t) {
  for (auto& frame : t.run.frames)
    for (std::size_t i = 0; i < t.s.initial.size(); ++i) {
      const auto row = static_cast<std::size_t>(t.s.initial.body[i]);
      const BodyState& b = frame.bodies[row];
      const Vec3 arm = rotate(b.orientation, t.s.initial.position[i] - t.s.job.bodies[row].properties.centre);
      frame.position[i] = b.position + arm;
      frame.velocity[i] = b.velocity + cross(b.angular_velocity, arm);
    }
}

/// What the audit says of a run whose bodies are changed in every frame but the first, particles with them.
std::string changed(Trial t, const std::function<void(BodyState&, double time)>& change) {
  t.s.job.resolution.time_step = step;
  for (auto& frame : t.run.frames)
    for (auto& b : frame.bodies) {
      b.mass = 1.0;
      if (frame.time > 0.0) change(b, frame.time);
    }
  place_particles(t);
  return t.sound();
}

Trial flight() { return {thrown_block(), "ballistic"}; }
/// 25 frames of 1.5 rad each, of a body that tumbles.
Trial tumbling() { return {block({1, 2, 3}, 10.0, 25), "torque_free"}; }

TEST(AuditOfMotion, LetsTheTruthPass) {
  EXPECT_EQ(changed(flight(), [](BodyState&, double) {}), "");
  EXPECT_EQ(changed(tumbling(), [](BodyState&, double) {}), "");
}

/// It lags by g h t/2: its way is that of its own velocities.
TEST(AuditOfMotion, LetsSemiImplicitEulerFallBehind) {
  for (const double sign : {1.0, -1.0})
    EXPECT_EQ(
        changed(flight(), [&](BodyState& b, double t) { b.position.z -= sign * 0.5 * 9.81 * step * t; }), "");
  const auto three_steps =
      changed(flight(), [](BodyState& b, double t) { b.position.z -= 1.5 * 9.81 * step * t; });
  EXPECT_TRUE(has(three_steps, "`block` moves otherwise than its velocity says")) << three_steps;
}

TEST(AuditOfMotion, FindsPlacesThatAreNotThoseOfTheVelocities) {
  const std::pair<const char*, std::function<void(BodyState&, double)>> ways[] = {
      {"teleport", [](BodyState& b, double t) { b.position.y += t > 0.55 ? 0.4 : 0.0; }},
      {"speed 0.05 % off", [](BodyState& b, double) { b.velocity *= 1.0005; }},
      {"a step late", [](BodyState& b, double) { b.position -= step * b.velocity; }},
      {"mirrored place", [](BodyState& b, double) { b.position.x *= -1.0; }},
      {"mirrored speed", [](BodyState& b, double) { b.velocity.x *= -1.0; }},
      {"no speed", [](BodyState& b, double) { b.velocity = {}; }}};
  for (const auto& [name, way] : ways) {
    const auto why = changed(flight(), way);
    EXPECT_TRUE(has(why, "`block` moves otherwise than its velocity says")) << name << ": " << why;
  }
}

/// Frames of 0.1 rad: a turn of one frame would be within what the spin of that frame lets it be.
TEST(AuditOfMotion, FindsASpinThatLeavesTheOthersForOneFrame) {
  const Trial fine{block({1, 2, 3}, 1.0, 40), "torque_free"};
  EXPECT_EQ(changed(fine, [](BodyState&, double) {}), "");
  for (const std::size_t frame : {std::size_t{1}, std::size_t{20}, std::size_t{38}}) {
    const double at = fine.run.frames[frame].time;
    const auto why =
        changed(fine, [&](BodyState& b, double t) { b.angular_velocity *= t == at ? -1.0 : 1.0; });
    EXPECT_TRUE(has(why, "contradicts itself")) << frame << ": " << why;
    const auto other =
        changed(fine, [&](BodyState& b, double t) { b.angular_velocity.y *= t == at ? -1.0 : 1.0; });
    EXPECT_TRUE(has(other, "the angular velocity of `block` leaves those")) << frame << ": " << other;
  }
}

TEST(AuditOfMotion, TakesTheRoundingsOfABodyAtRest) {
  const Trial still{block({1, 2, 3}, 1.0, 40), "torque_free"};
  const auto noisy = [](double size) {
    return [size](BodyState& b, double t) { b.velocity.x += size * std::sin(1e4 * t); };
  };
  EXPECT_EQ(changed(still, noisy(1e-16)), "");
  EXPECT_TRUE(has(changed(still, noisy(1e-3)), "contradicts itself"));
}

TEST(AuditOfMotion, FindsTurnsThatAreNotThoseOfTheSpin) {
  const std::pair<const char*, std::function<void(BodyState&, double)>> ways[] = {
      {"wrong sign", [](BodyState& b, double) { b.angular_velocity *= -1.0; }},
      {"body frame",
       [](BodyState& b, double) { b.angular_velocity = rotate_back(b.orientation, b.angular_velocity); }},
      {"conjugated", [](BodyState& b, double) { b.orientation = conjugate(b.orientation); }},
      {"no turn", [](BodyState& b, double) { b.orientation = {}; }},
      {"no spin", [](BodyState& b, double) { b.angular_velocity = {}; }}};
  for (const auto& [name, way] : ways) {
    const auto why = changed(tumbling(), way);
    EXPECT_TRUE(has(why, "`block` turns otherwise than its angular velocity says")) << name << ": " << why;
  }
}

/// A wrong law is for the gates to find; the run itself is whole.
TEST(AuditOfMotion, LetsAnEngineWithoutGyroscopicTermPass) {
  const Vec3 spin{1, 2, 3};
  EXPECT_EQ(changed(tumbling(),
                    [&](BodyState& b, double t) {
                      b.angular_velocity = spin;
                      b.orientation = from_rotation_vector(t * spin);
                    }),
            "");
}

/// Two cubes that lie on each other, which change places between two frames and say that they do not move.
TEST(AuditOfMotion, FindsBodiesThatChangePlaces) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  add_body(s, "floor", {{8, 8, 1}, 0.1, {-0.4, -0.4, -0.1}, 1.0}, {}, Motion::fixed);
  for (const double height : {0.0, 0.4})
    add_body(s, height > 0.0 ? "upper" : "lower", {{4, 4, 4}, 0.1, {-0.2, -0.2, height}, 1.0}, {});
  set_times(s, 1.0, 20);
  Still still(s);
  for (auto& frame : still.run.frames)
    for (auto& b : frame.bodies) b.mass = 1.0;
  EXPECT_EQ(audit(still.s.job, still.s.initial, still.run), "");
  for (std::size_t n = 1; n < still.run.frames.size(); ++n) {
    auto& frame = still.run.frames[n];
    std::swap(frame.bodies[1], frame.bodies[2]);
    still.shift(frame, 1, {0, 0, 0.4});
    still.shift(frame, 2, {0, 0, -0.4});
  }
  const auto why = audit(still.s.job, still.s.initial, still.run);
  EXPECT_TRUE(
      has(why, "`lower` moves otherwise than its velocity says from t = 0.000000 to 0.050000 s: by 8"))
      << why;
}

TEST(AuditOfMotion, FindsARowThatIsHeavierThanItsParticles) {
  const auto why = changed(flight(), [](BodyState& b, double) { b.mass *= 1.001; });
  EXPECT_TRUE(has(why, "`block` has another mass than its particles")) << why;
}

TEST(AuditOfMotion, TheFirstFrameHasTheJobsVelocitiesAndSpin) {
  auto t = flight();
  t.run.frames[0].bodies[0].angular_velocity = {3, 2, 1};
  EXPECT_TRUE(has(t.sound(), "`block` has another angular velocity")) << t.sound();
  auto faster = flight();
  for (auto& v : faster.run.frames[0].velocity) v *= 1.01;
  EXPECT_TRUE(has(faster.sound(), "has another velocity")) << faster.sound();
}

/// Liquid has no row: its particles are compared, one by one and together.
TEST(AuditOfMotion, FindsLiquidThatContradictsItself) {
  auto s = blocks();
  for (std::size_t i = 0; i < s.initial.size(); ++i) s.initial.velocity[i] = {1.0, 0.0, 0.0};
  for (auto& b : s.job.bodies) b.velocity = {1.0, 0.0, 0.0};
  Still moving(s);
  for (auto& frame : moving.run.frames) {
    for (auto& x : frame.position) x.x += frame.time;
    for (auto& b : frame.bodies) {
      b.mass = 64.0;
      b.velocity = {1.0, 0.0, 0.0};
      b.position.x += frame.time;
    }
  }
  const auto sound = [](const Still& m) { return audit(m.s.job, m.s.initial, m.run); };
  EXPECT_EQ(sound(moving), "");
  auto jump = moving;
  jump.run.frames[2].position.back().y += 3.0;
  EXPECT_TRUE(has(sound(jump), "moves otherwise than its velocity says")) << sound(jump);
  auto slow = moving;
  for (auto& frame : slow.run.frames)
    if (frame.time > 0.0) slow.shift(frame, 2, {-0.05 * frame.time, 0, 0});
  EXPECT_TRUE(has(sound(slow), "the matter of `pool` moves otherwise than its velocity says")) << sound(slow);
}

TEST(AuditOfGauges, AGaugeSaysWhatTheParticlesShow) {
  auto t = flight();
  t.s.job.gauges = {{"height", "centre", "block", {{"axis", std::string("z")}}}};
  for (auto& frame : t.run.frames) frame.gauges["height"] = frame.bodies[0].position.z + 1e-6;
  EXPECT_EQ(t.sound(), "");
  t.run.frames.back().gauges["height"] +=
      0.01;  // a rigid body's place is known better than particles are apart
  EXPECT_TRUE(has(t.sound(), "the gauge `height` says")) << t.sound();
}

}  // namespace
}  // namespace tripoint
