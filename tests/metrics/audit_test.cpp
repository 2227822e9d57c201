// SPDX-License-Identifier: BSD-3-Clause
// Right runs that look frozen at output times, and frozen ones that do not get away with it.
#include <gtest/gtest.h>

#include <algorithm>

#include "fakes.hpp"

namespace tripoint {
namespace {

using namespace test;

/// A body on a principal axis, one frame a turn.
Prepared spinning(double turns_a_frame) {
  auto s = block({0.0, 0.0, 10.0}, turns_a_frame * 2.0 * pi / 10.0 * 5.0, 5);
  s.job.reference.kind = ReferenceKind::invariant;
  s.job.reference.function = "";
  return s;
}

void freeze(Trajectory& run) {
  for (auto& f : run.frames) {
    const double time = f.time;
    f = run.frames.front();
    f.time = time;
  }
}

TEST(Audit, LetsABodyBeWhereItWasAfterAWholeTurn) {
  Trial whole(spinning(1.0), "torque_free");
  freeze(whole.run);
  EXPECT_EQ(whole.sound(), "");
  Trial half(spinning(0.5), "torque_free");
  freeze(half.run);
  EXPECT_NE(half.sound().find("frozen"), std::string::npos);
}

TEST(Audit, FindsAFrozenFlightThatSpinsByWholeTurns) {
  auto s = spinning(1.0);
  s.job.bodies[0].velocity = {1.0, 0.0, 0.0};
  for (auto& v : s.initial.velocity) v += Vec3{1.0, 0.0, 0.0};
  Trial t(std::move(s), "torque_free");
  freeze(t.run);
  EXPECT_NE(t.sound().find("frozen"), std::string::npos);
}

/// A body that friction has stopped keeps a speed in the last digits, which moves it by nothing.
TEST(Audit, LetsABodyLieThatKeepsARoundingOfItsSpeed) {
  for (const double speed : {1e-18, 1e-3}) {
    Trial t(thrown_block(), "ballistic");
    t.s.job.scene.gravity = {};  // it lies where nothing pulls
    auto& frames = t.run.frames;
    for (auto* f : {&frames[frames.size() - 3], &frames[frames.size() - 2], &frames.back()}) {
      f->position = frames[frames.size() - 3].position;
      for (auto& v : f->velocity) v = {speed, 0.0, 0.0};
    }
    EXPECT_EQ(t.sound().find("frozen") != std::string::npos, speed > 1e-12) << t.sound();
  }
}

/// A thrown block above a floor that it comes to rest on, or stops in the air of, after half the time;
/// `speed` is what it says that it has then [m/s].
Trial stopped(double floor_below, double speed, bool from_the_start = false) {
  auto s = thrown_block();
  const double lowest = std::ranges::min(s.initial.position, {}, [](const Vec3& x) { return x.z; }).z;
  add_body(s, "floor", {{20, 20, 1}, 0.1, {-0.5, -0.5, lowest - floor_below}, 400.0}, {}, Motion::fixed);
  Trial t(std::move(s), "ballistic");
  auto& frames = t.run.frames;
  const std::size_t begin = from_the_start ? 0 : frames.size() / 2, block = t.s.initial.source.size() - 400;
  for (std::size_t n = begin; n < frames.size(); ++n) {
    for (std::size_t i = 0; i < block; ++i)
      frames[n].position[i] = t.s.initial.position[i];  // it lies where it began, above the floor
    if (n > 0)
      for (std::size_t i = 0; i < block; ++i)
        frames[n].velocity[i] = {speed * (1.0 + 1e-3 * static_cast<double>(n)), 0.0, 0.0};
  }
  return t;
}

/// Rounding of a coordinate in single precision hides a creep of nanometres a second; gravity does not move
/// what lies.
TEST(Audit, LetsABodyLieThatCreepsByLessThanItsCoordinatesResolve) {
  EXPECT_EQ(stopped(0.1, 1e-9).sound().find("frozen"), std::string::npos) << stopped(0.1, 1e-9).sound();
  EXPECT_NE(stopped(0.1, 1e-3).sound().find("yet they have velocities"), std::string::npos);
}

/// A step of single precision adds less than half a unit, so that a body creeps by its velocity alone.
TEST(Audit, LetsABodyOfSinglePrecisionCreepByLessThanAStepAdds) {
  Trial t = stopped(0.1, 3e-6);
  t.s.job.resolution.time_step = 0.01;
  const auto says = [&](const char* precision) {
    Readback held;
    held.precision = precision;
    return audit(t.s.job, t.s.initial, t.run, held);
  };
  EXPECT_NE(says("double").find("yet they have velocities"), std::string::npos);
  EXPECT_EQ(says("single").find("yet they have velocities"), std::string::npos);
}

TEST(Audit, FindsABodyThatHangsInTheAirWhateverSpeedItSays) {
  for (const double speed : {0.0, 1e-9, 1e-3})
    EXPECT_NE(stopped(1.0, speed).sound().find("frozen"), std::string::npos) << speed;
  EXPECT_NE(stopped(1.0, 1e-9).sound().find("hangs in the air"), std::string::npos);
}

/// Within three spacings another body may bear it; a change of velocity by half of what gravity gives is no
/// hanging.
TEST(Audit, ABodyHangsThatNoOtherIsNearAndThatKeepsItsVelocity) {
  const auto hangs = [](const Trial& t) { return t.sound().find("hangs in the air") != std::string::npos; };
  EXPECT_FALSE(hangs(stopped(0.34, 0.0)));  // 0.29 m between the nearest particles
  EXPECT_TRUE(hangs(stopped(0.36, 0.0)));
  for (const auto& [jump, still] : {std::pair{0.48, true}, std::pair{0.50, false}}) {  // g dt/2 = 0.49 m/s
    auto t = stopped(1.0, 0.0);
    for (std::size_t n = 1; n < t.run.frames.size(); n += 2)
      for (std::size_t i = 0; i < t.s.initial.source.size() - 400; ++i)
        t.run.frames[n].velocity[i] = {jump, 0, 0};
    EXPECT_EQ(hangs(t), still) << t.sound();
  }
}

/// All places are those of the start: other velocities do not make it a run.
TEST(Audit, FindsARunWhosePlacesAreThoseOfTheStart) {
  EXPECT_NE(stopped(0.1, 0.0, true).sound().find("nothing has moved by the end"), std::string::npos)
      << stopped(0.1, 0.0, true).sound();
}

/// Two frames at the same height, one on the way up and one on the way down.
TEST(Audit, LetsAThrownBodyComeBack) {
  auto s = thrown_block();
  for (auto& v : s.initial.velocity) v = {0.0, 0.0, 9.81};
  s.job.bodies[0].velocity = {0.0, 0.0, 9.81};
  s.job.bodies[0].angular_velocity = {};
  set_times(s, 2.0, 1);
  Trial t(std::move(s), "ballistic");
  auto& last = t.run.frames.back();
  last.position = t.run.frames.front().position;  // to the last digit
  last.bodies[0].orientation = {};
  EXPECT_EQ(t.sound(), "");
  last.velocity = t.run.frames.front().velocity;
  EXPECT_NE(t.sound().find("frozen"), std::string::npos);
}

TEST(Audit, LetsWhatItsOwnExactSolutionSaysComeBack) {
  auto s = spinning(1.0);
  s.job.bodies[0].velocity = {0.0, 0.0, 0.0};
  s.job.bodies[0].angular_velocity = {3.0, 0.0, 4.0};  // no principal axis: no whole turn by itself
  s.job.reference = function("keyframes");
  s.job.bodies[0].motion = s.job.scene.bodies[0].motion = Motion::prescribed;
  s.job.bodies[0].keyframes = {
      {0.0, {}, {}}, {0.5, {1.0, 0.0, 0.0}, {}}, {1.0, {}, {}}, {1.5, {1.0, 0.0, 0.0}, {}}, {2.0, {}, {}}};
  s.job.scene.bodies[0].keyframes = s.job.bodies[0].keyframes;
  set_times(s, 2.0, 2);
  for (auto& v : s.initial.velocity) v = {2.0, 0.0, 0.0};
  Trial t(std::move(s), "keyframes");
  EXPECT_EQ(t.sound(), "") << "there and back between two frames";
}

TEST(Audit, LetsTwoKeyframesHoldABodyStill) {
  auto s = spinning(1.0);
  s.job.bodies[0].motion = s.job.scene.bodies[0].motion = Motion::prescribed;
  s.job.bodies[0].angular_velocity = {};
  s.job.bodies[0].keyframes = {{0.0, {}, {}}, {2.0, {}, {}}};
  s.job.scene.bodies[0].keyframes = s.job.bodies[0].keyframes;
  for (auto& v : s.initial.velocity) v = {};
  set_times(s, 2.0, 2);
  Trial still(s, "keyframes");
  EXPECT_EQ(still.sound(), "");
  auto& keyframes = still.s.job.bodies[0].keyframes;
  keyframes = {{0.0, {}, {}}, {2.0, {1.0, 0.0, 0.0}, {}}};
  EXPECT_NE(still.sound().find("nothing has moved by the end"), std::string::npos);
}

TEST(Audit, LetsOneKeyframeHoldABodyAgainstGravity) {
  auto s = spinning(1.0);
  s.job.scene.gravity = {0.0, 0.0, -10.0};
  s.job.bodies[0].motion = s.job.scene.bodies[0].motion = Motion::prescribed;
  s.job.bodies[0].angular_velocity = {};
  s.job.bodies[0].keyframes = s.job.scene.bodies[0].keyframes = {{0.0, {}, {}}};
  for (auto& v : s.initial.velocity) v = {};
  set_times(s, 2.0, 2);
  EXPECT_EQ(Trial(s, "keyframes").sound(), "");
}

/// A hot and a cold block, apart by a gap of whole spacings.
Prepared hot_and_cold(int gap) {
  auto s = bar(
      {4, 4, 4}, 0.1, [](const Vec3&) { return 400.0; }, 1000.0, 2, false);
  add_body(s, "floor", {{4, 4, 4}, 0.1, {0.0, 0.0, -0.4 - 0.1 * gap}, 64.0}, {}, Motion::fixed);
  s.initial.temperature.resize(128, 300.0);
  return s;
}

TEST(Audit, AsksForNoHeatBetweenBodiesThatDoNotTouch) {
  const auto kept = [](Prepared s) {
    Trial t(std::move(s), "invariant");
    for (auto& f : t.run.frames) {
      f.position = t.s.initial.position;
      f.velocity = t.s.initial.velocity;
      f.temperature = t.s.initial.temperature;
    }
    return t.sound();
  };
  EXPECT_EQ(kept(hot_and_cold(3)), "");
  EXPECT_NE(kept(hot_and_cold(0)).find("no temperature has changed"), std::string::npos);
  auto held = hot_and_cold(0);
  for (auto& b : held.job.bodies) b.temperature_held = true;
  EXPECT_EQ(kept(held), "") << "both are held";
  auto brief = hot_and_cold(0);
  set_times(brief, 1e-12, 2);
  EXPECT_EQ(kept(brief), "") << "less than the last digit flows";
}

}  // namespace
}  // namespace tripoint
