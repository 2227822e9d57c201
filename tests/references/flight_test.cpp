// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "references/scenes.hpp"
#include "validation/references/prescribed.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/rigid_flight.hpp"

namespace tripoint {
namespace {

using test::Prepared;

Prepared thrown_cube() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  test::add_body(s, "cube", {}, {{1, 0, 5}, (7.0 / std::sqrt(14.0)) * Vec3{1, 2, 3}});
  test::set_times(s, 1.0, 100);
  return s;
}

Vec3 total_angular_momentum(const Snapshot& s, const std::vector<double>& mass) {
  Vec3 L;
  for (std::size_t i = 0; i < mass.size(); ++i) L += mass[i] * cross(s.position[i], s.velocity[i]);
  return L;
}

TEST(Ballistic, FollowsTheParabolaAndTurnsEveryParticleWithTheBody) {
  const auto s = thrown_cube();
  const auto end = make_reference(test::function("ballistic"), s.job, s.initial)->at(1.0);
  const Vec3 centre = s.job.bodies[0].properties.centre;
  EXPECT_LT(norm(end.bodies[0].position - (centre + Vec3{1, 0, 5 - 4.905})), 1e-14);
  EXPECT_LT(norm(end.bodies[0].velocity - Vec3{1, 0, 5 - 9.81}), 1e-14);
  EXPECT_LT(
      angle_between(end.bodies[0].orientation, from_rotation_vector((7.0 / std::sqrt(14.0)) * Vec3{1, 2, 3})),
      1e-14);
  const Vec3 arm = rotate(end.bodies[0].orientation, s.initial.position[5] - centre);
  EXPECT_LT(norm(end.position[5] - end.bodies[0].position - arm), 1e-14);
}

TEST(Ballistic, HasVelocitiesThatAreTheRatesOfItsPositions) {
  auto s = test::block({1, 2, 3}, 2.0, 10);
  s.job.scene.gravity = {0.3, -1, -9.81};
  const auto reference = make_reference(test::function("torque_free"), s.job, s.initial);
  const double h = 1e-4;  // central difference: h^2 r''' / 6 = 1e-7
  const auto before = reference->at(1.3 - h), now = reference->at(1.3), after = reference->at(1.3 + h);
  for (std::size_t i = 0; i < s.initial.size(); i += 37)
    EXPECT_LT(norm((after.position[i] - before.position[i]) / (2 * h) - now.velocity[i]), 1e-6);
}

TEST(BallisticSemiImplicit, IsWhatTheSchemeDoesStepByStep) {
  auto s = thrown_cube();
  s.job.resolution.time_step = 0.01;
  const auto reference = make_reference(test::function("ballistic_semi_implicit"), s.job, s.initial);
  Vec3 x = s.job.bodies[0].properties.centre, v = s.job.bodies[0].velocity;
  for (int n = 0; n < 100; ++n) {
    v += 0.01 * s.job.scene.gravity;
    x += 0.01 * v;
  }
  EXPECT_LT(norm(reference->at(1.0).bodies[0].position - x), 1e-13);  // round-off of 100 sums
  const auto exact = make_reference(test::function("ballistic"), s.job, s.initial);
  EXPECT_NEAR(exact->at(1.0).bodies[0].position.z - x.z, 0.04905, 1e-13);  // g dt T/2
}

TEST(BallisticSemiImplicit, ShortensItsStepsToMeetTheOutputTimes) {
  auto s = thrown_cube();
  s.job.resolution.time_step = 0.004;  // three steps of 10/3 ms to each output time
  const auto reference = make_reference(test::function("ballistic_semi_implicit"), s.job, s.initial);
  Vec3 x = s.job.bodies[0].properties.centre, v = s.job.bodies[0].velocity;
  for (int n = 0; n < 300; ++n) {
    v += (0.01 / 3) * s.job.scene.gravity;
    x += (0.01 / 3) * v;
  }
  EXPECT_LT(norm(reference->at(1.0).bodies[0].position - x), 1e-13);
}

TEST(BallisticSemiImplicit, RefusesATumblingBodyAndAMissingTimeStep) {
  auto s = test::block({1, 2, 3}, 1.0, 10);
  EXPECT_THROW((void)make_reference(test::function("ballistic_semi_implicit"), s.job, s.initial), InputError);
  s.job.resolution.time_step = 0.01;
  EXPECT_THROW((void)make_reference(test::function("ballistic_semi_implicit"), s.job, s.initial), InputError);
}

/// The merge of the rigid notes (R15): a cube and a 3 x 3 x 5 block of particles of 1/64 kg, spacing 0.1.
Prepared merging_pair() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  test::add_body(s, "cube", {{4, 4, 4}, 0.1, {-0.2, -0.2, -0.2}, 1.0}, {{1, 0, 0}, {1, 2, 0}});
  test::add_body(s, "rod", {{3, 3, 5}, 0.1, {0.45 - 0.15, 0.05 - 0.15, -0.25}, 45.0 / 64.0},
                 {{-1, 0.2, 0}, {0, -1, 3}});
  Event merge;
  merge.kind = Event::Kind::merge;
  merge.time = 0.0;
  merge.bodies = {"cube", "rod"};
  s.job.scene.events.push_back(merge);
  test::set_times(s, 1.0, 10);
  return s;
}

TEST(MergeInFlight, KeepsMassMomentumAndAngularMomentumAndLosesTheKnownEnergy) {
  auto s = merging_pair();
  const auto reference = make_reference(test::function("merge_in_flight"), s.job, s.initial);
  // Measured with Bullet's mass properties, six digits
  EXPECT_NEAR(*reference->number("energy_ratio"), 0.093563, 1e-6);
  const auto end = reference->at(1.0);
  Vec3 before, after;
  for (std::size_t i = 0; i < s.initial.size(); ++i) {
    before += s.initial.mass[i] * s.initial.velocity[i];
    after += s.initial.mass[i] * end.velocity[i];
  }
  EXPECT_LT(norm(after - before), 1e-14);
  Snapshot start;
  start.position = s.initial.position;
  start.velocity = s.initial.velocity;
  EXPECT_LT(norm(total_angular_momentum(end, s.initial.mass) - total_angular_momentum(start, s.initial.mass)),
            1e-13);
  EXPECT_TRUE(std::isnan(end.bodies[1].position.x));  // absorbed
  EXPECT_EQ(end.body.back(), 0);
}

TEST(MergeInFlight, FliesFreelyBeforeTheEvent) {
  auto s = merging_pair();
  s.job.scene.events[0].time = 0.1;
  const auto reference = make_reference(test::function("merge_in_flight"), s.job, s.initial);
  const auto early = reference->at(0.05);
  EXPECT_NEAR(early.bodies[1].position.x, 0.45 - 0.05, 1e-14);
  EXPECT_NEAR(*reference->number("event_time"), 0.1, 0.0);
  const double h = 1e-9;  // positions do not jump at the event
  EXPECT_LT(norm(reference->at(0.1 - h).position.back() - reference->at(0.1).position.back()), 1e-8);
}

TEST(SplitInFlight, GivesEachPartTheVelocitiesOfItsParticles) {
  auto s = test::block({1, 2, 3}, 1.0, 10);
  Event split;
  split.kind = Event::Kind::split;
  split.time = 0.5;
  split.name = "half";
  split.region = Shape{};
  split.region->kind = Shape::Kind::half_space;
  split.region->normal = {0, 0, 1};
  s.job.scene.events.push_back(split);
  const auto reference = make_reference(test::function("split_in_flight"), s.job, s.initial);
  EXPECT_NEAR(*reference->number("energy_ratio"), 1.0, 1e-14);
  const auto before = reference->at(0.5 - 1e-12), after = reference->at(0.5), end = reference->at(1.0);
  ASSERT_EQ(before.bodies.size(), 1U);
  ASSERT_EQ(after.bodies.size(), 2U);
  EXPECT_NEAR(after.bodies[0].mass + after.bodies[1].mass, 1.0, 1e-14);
  for (std::size_t i = 0; i < s.initial.size(); i += 11)
    EXPECT_LT(norm(after.velocity[i] - before.velocity[i]), 1e-10);
  const Vec3 L = total_angular_momentum(before, s.initial.mass);
  EXPECT_LT(norm(total_angular_momentum(end, s.initial.mass) - L), 1e-13);
  EXPECT_EQ(after.bodies[1].orientation, Quaternion{});
}

TEST(Flight, RefusesWhatItIsNotExactFor) {
  auto s = thrown_cube();
  s.job.bodies[0].phase = Phase::liquid;
  EXPECT_THROW((void)make_reference(test::function("ballistic"), s.job, s.initial), InputError);
  EXPECT_THROW((void)make_reference(test::function("balistic"), s.job, s.initial), InputError);
  EXPECT_THROW((void)make_reference(test::function("ballistic", {{"speed", 1.0}}), s.job, s.initial),
               InputError);
  EXPECT_THROW((void)make_reference(ReferenceChoice{}, s.job, s.initial), InputError);
}

TEST(Keyframes, GoStraightBetweenPositionsAndTurnAtConstantRate) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  test::add_body(s, "board", {}, {}, Motion::prescribed);
  const Vec3 centre = s.job.bodies[0].properties.centre;
  const Quaternion quarter = from_rotation_vector({0, 0, test::pi / 2});
  s.job.bodies[0].keyframes = {
      {0.0, centre, {}}, {1.0, centre + Vec3{1, 0, 0}, quarter}, {2.0, centre, quarter}};
  test::set_times(s, 2.0, 20);
  const auto reference = make_reference(test::function("keyframes"), s.job, s.initial);
  const auto half = reference->at(0.5);
  EXPECT_LT(norm(half.bodies[0].position - centre - Vec3{0.5, 0, 0}), 1e-15);
  EXPECT_LT(angle_between(half.bodies[0].orientation, from_rotation_vector({0, 0, test::pi / 4})), 1e-15);
  EXPECT_LT(norm(half.bodies[0].angular_velocity - Vec3{0, 0, test::pi / 2}), 1e-15);
  EXPECT_LT(norm(reference->at(1.5).bodies[0].velocity - Vec3{-1, 0, 0}), 1e-15);
  EXPECT_LT(norm(reference->at(3.0).bodies[0].position - centre), 1e-15);
  EXPECT_EQ(reference->at(2.0).bodies[0].velocity, Vec3{});  // at rest after the last keyframe
  const double h = 1e-5;
  for (const std::size_t i : {0U, 17U, 63U})
    EXPECT_LT(norm((reference->at(0.5 + h).position[i] - reference->at(0.5 - h).position[i]) / (2 * h) -
                   half.velocity[i]),
              1e-9);
}

}  // namespace
}  // namespace tripoint
