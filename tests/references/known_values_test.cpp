// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions at places and times where their figures can be worked out by hand, and at the edges of what
// they know.
#include <gtest/gtest.h>

#include <cmath>

#include "references/solids.hpp"
#include "validation/references/elliptic_drop.hpp"
#include "validation/references/plane_shear.hpp"
#include "validation/references/prescribed.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/region.hpp"
#include "validation/references/rigid_body.hpp"

namespace tripoint {
namespace {

using test::made;
using test::pi;
using test::Prepared;

void expect_near(const Vec3& a, const Vec3& b, double tolerance, const std::string& what) {
  EXPECT_NEAR(norm(a - b), 0.0, tolerance) << what;
}

// --- places

TEST(KnownPlaces, OnTheSurfaceOfARegionAreInIt) {
  Shape box, ball, tube, half, both, hollow;
  box.min = {1, 2, 3};
  box.max = {2, 4, 6};
  ball.kind = Shape::Kind::sphere;
  ball.centre = {1, 0, 0};
  ball.radius = 5.0;
  tube.kind = Shape::Kind::cylinder;
  tube.base = {1, 1, 1};
  tube.axis = {0, 0, 2};
  tube.length = 3.0;
  tube.radius = 5.0;
  half.kind = Shape::Kind::half_space;
  half.point = {0, 0, 1};
  half.normal = {0, 0, 1};
  both.kind = Shape::Kind::unite;
  both.of = {box, ball};
  hollow.kind = Shape::Kind::difference;
  hollow.of = {ball, box};
  struct Row {
    const Shape& shape;
    Vec3 place;
    bool in;
  };
  for (const Row& row :
       {Row{box, {1, 2, 3}, true},        Row{box, {2, 4, 6}, true},        Row{box, {0.999, 3, 4}, false},
        Row{box, {1.5, 1.999, 4}, false}, Row{box, {1.5, 3, 2.999}, false}, Row{box, {2.001, 3, 4}, false},
        Row{box, {1.5, 4.001, 4}, false}, Row{box, {1.5, 3, 6.001}, false}, Row{ball, {4, 4, 0}, true},
        Row{ball, {4, 4.001, 0}, false},  Row{tube, {4, 5, 1}, true},       Row{tube, {4, 5, 4}, true},
        Row{tube, {1, 1, 0.999}, false},  Row{tube, {1, 1, 4.001}, false},  Row{tube, {4, 5.001, 2}, false},
        Row{half, {7, 8, 1}, true},       Row{half, {7, 8, 1.001}, false},  Row{both, {-3, 0, 0}, true},
        Row{both, {2, 4, 6}, true},       Row{both, {-4.1, 0, 0}, false},   Row{hollow, {1.5, 3, 3.5}, false},
        Row{hollow, {-3, 0, 0}, true},    Row{hollow, {9, 0, 0}, false}})
    EXPECT_EQ(inside(row.shape, row.place), row.in)
        << static_cast<int>(row.shape.kind) << " " << row.place.x << " " << row.place.y << " " << row.place.z;
}

TEST(KnownPlaces, OfAPrescribedBodyAreThoseOfItsKeyframes) {
  JobBody body;
  body.motion = Motion::prescribed;
  body.properties.mass = 3.0;
  body.properties.centre = {1, 0, 0};
  body.velocity = {0, 2, 0};
  body.angular_velocity = {0, 0, 1.5};
  const auto moved = prescribed_motion(body, 2.0);
  expect_near(moved.position, {1, 4, 0}, 1e-15, "without keyframes");
  EXPECT_NEAR(angle_between(moved.orientation, from_rotation_vector({0, 0, 3.0})), 0.0, 1e-7);
  EXPECT_EQ(moved.angular_velocity.z, 1.5);
  body.motion = Motion::fixed;
  expect_near(prescribed_motion(body, 2.0).position, {1, 0, 0}, 1e-15, "fixed");
  expect_near(prescribed_motion(body, 2.0).velocity, {}, 1e-15, "fixed");
  body.motion = Motion::prescribed;
  body.keyframes = {{1.0, {0, 0, 0}, {}},
                    {3.0, {4, 0, 0}, from_rotation_vector({0, 0, 0.5})},
                    {4.0, {4, 1, 0}, from_rotation_vector({0, 0, 0.5})}};
  struct Row {
    double time;
    Vec3 place, velocity;
    double turned, spin;
  };
  for (const Row& row : {Row{0.0, {}, {}, 0.0, 0.0}, Row{1.0, {}, {2, 0, 0}, 0.0, 0.25},
                         Row{2.0, {2, 0, 0}, {2, 0, 0}, 0.25, 0.25}, Row{3.0, {4, 0, 0}, {0, 1, 0}, 0.5, 0.0},
                         Row{3.5, {4, 0.5, 0}, {0, 1, 0}, 0.5, 0.0}, Row{4.0, {4, 1, 0}, {}, 0.5, 0.0},
                         Row{9.0, {4, 1, 0}, {}, 0.5, 0.0}}) {
    const auto s = prescribed_motion(body, row.time);
    expect_near(s.position, row.place, 1e-14, std::to_string(row.time));
    expect_near(s.velocity, row.velocity, 1e-14, std::to_string(row.time));
    EXPECT_NEAR(angle_between(s.orientation, from_rotation_vector({0, 0, row.turned})), 0.0, 1e-7)
        << row.time;
    EXPECT_NEAR(s.angular_velocity.z, row.spin, 1e-14) << row.time;
    EXPECT_EQ(s.mass, 3.0);
  }
}

TEST(KnownPlaces, OfARigidBodyAreThoseOfItsParticles) {
  // masses 1 and 3 kg at (0, 0, 0) and (4, 0, 0), the second at 2 m/s along y: centre at 3, momentum 6, spin
  // 1 x 3 x 1.5 + 3 x 1 x 0.5
  const auto b = rigid_body({0, 1}, {{0, 0, 0}, {4, 0, 0}}, {{}, {0, 2, 0}}, {1.0, 3.0});
  EXPECT_EQ(b.mass, 4.0);
  expect_near(b.centre, {3, 0, 0}, 1e-15, "centre");
  expect_near(b.velocity, {0, 1.5, 0}, 1e-15, "velocity");
  expect_near(b.angular_momentum, {0, 0, 6}, 1e-14, "3 m x 1.5 m/s x 1 kg + 1 m x 0.5 m/s x 3 kg");
  expect_near(b.inertia, {0, 12, 12}, 1e-12, "9 + 3");
  expect_near(b.angular_velocity, {0, 0, 0.5}, 1e-14, "spin");
  EXPECT_EQ(kinetic_energy({{}, {0, 2, 0}}, {1.0, 3.0}), 6.0);
}

TEST(KnownPlaces, TheLongAxisIsTheFirstOfTheLongestThatAreOpen) {
  const auto axis = [](std::array<int, 3> count, std::array<bool, 3> periodic) {
    Prepared s;
    s.job.scene.spacing = 0.1;
    test::add_matter(s, "block", Phase::elastic, {count, 0.1, {}, 1.0}, {}, 1000.0);
    test::make_elastic(s, 0, {});
    test::close_box(s, {}, {9, 9, 9}, periodic);
    return made(s, "pressed_block", {{"pressure", 1.0}})->measuring().axis;
  };
  const std::array<bool, 3> open{};
  EXPECT_EQ(axis({4, 4, 4}, open), 0u);
  EXPECT_EQ(axis({2, 4, 4}, open), 1u);
  EXPECT_EQ(axis({2, 2, 4}, open), 2u);
  EXPECT_EQ(axis({4, 2, 3}, open), 0u);
  EXPECT_EQ(axis({8, 2, 3}, {true, false, false}), 2u);
  EXPECT_EQ(axis({8, 3, 3}, {true, false, false}), 1u);
  EXPECT_EQ(axis({2, 3, 8}, {false, false, true}), 1u);
}

// --- liquids

TEST(KnownLiquids, ABlockFloatsByItsDensityWhicheverWayIsUp) {
  for (const double up : {1.0, -1.0}) {
    auto s = test::pool(350.0);
    s.job.scene.gravity.z = -9.81 * up;
    const auto rest = made(s, "archimedes");
    for (const auto& [name, figure] :
         {std::pair{"draught", 0.14}, std::pair{"up", up}, std::pair{"floor", up > 0.0 ? 0.0 : -0.5},
          std::pair{"pool_area", 1.0}, std::pair{"block_area", 0.16}, std::pair{"liquid_volume", 0.5},
          std::pair{"keel", 0.2}})
      EXPECT_NEAR(*rest->number(name), figure, 1e-12) << name << up;
    EXPECT_EQ(rest->measuring().axis, 2u);
    s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
    const auto start = made(s, "added_mass"), walled = made(s, "added_mass", {{"radius_over_wall", 0.5}});
    EXPECT_NEAR(*start->number("acceleration"), 0.65 / 0.85 * 9.81, 1e-12);
    EXPECT_NEAR(*walled->number("acceleration"), 0.65 / (0.35 + 0.5 * 1.375) * 9.81, 1e-12);
    EXPECT_EQ(start->number("up"), up);
  }
}

TEST(KnownLiquids, LayersBearTheirWeightWhicheverWayIsUp) {
  for (const double up : {1.0, -1.0}) {
    auto s = test::layers(5.0);
    s.job.scene.gravity.z = -9.81 * up;
    const auto rest = made(s, "hydrostatic");
    const double heavy = 1000.0 * 9.81, light = 200.0 * 9.81;
    EXPECT_NEAR(*rest->number("bottom_pressure"), 0.4 * (heavy + light), 1e-9);
    EXPECT_NEAR(*rest->number("interface"), 0.4, 1e-12);
    EXPECT_NEAR(*rest->number("interface_pressure"), 0.4 * (up > 0.0 ? light : heavy), 1e-9);
    Snapshot now;
    now.position = s.initial.position;
    const auto at = [&](double z) {
      now.position[0].z = z;
      return rest->truth_for(now).pressure[0];
    };
    EXPECT_NEAR(at(0.1), up > 0.0 ? 0.4 * light + 0.3 * heavy : 0.1 * heavy, 1e-9);
    EXPECT_NEAR(at(0.7), up > 0.0 ? 0.1 * light : 0.4 * heavy + 0.3 * light, 1e-9);
    EXPECT_EQ(at(up > 0.0 ? 0.9 : -0.1), 0.0);
    EXPECT_NEAR(at(up > 0.0 ? -0.1 : 0.9), 0.4 * (heavy + light) + 0.1 * (up > 0.0 ? heavy : light), 1e-9)
        << "below the floor it goes on";
    EXPECT_EQ(rest->truth_for(now).density[0], 1000.0);
    EXPECT_EQ(rest->truth_for(now).density[64], 200.0);
    EXPECT_FALSE(rest->number("another"));
  }
}

TEST(KnownLiquids, ADropIsPressedLeastAtItsSurface) {
  VelocityField v;
  v.kind = VelocityField::Kind::linear;
  v.centre = {0.5, 0.5, 0};
  v.gradient[0] = {-2, 0, 0};
  v.gradient[1] = {0, 2, 0};
  auto s = test::swinging(v, 10);
  s.job.scene.bodies[0].shape.kind = Shape::Kind::cylinder;
  s.job.scene.bodies[0].shape.radius = 0.5;
  const auto drop = made(s, "elliptic_drop");
  for (const double time : {0.0, 0.2}) {
    const auto now = elliptic_drop(2.0, 0.5, time);
    EXPECT_NEAR(now.a * now.b, 0.25, 1e-12);
    const double h = 1e-4, change = (elliptic_drop(2.0, 0.5, time + h).rate -
                                     (time > 0.0 ? elliptic_drop(2.0, 0.5, time - h).rate : 2.0)) /
                                    (time > 0.0 ? 2.0 * h : h);
    // along x Euler's equation is rho (A^2 - A') x = -dp/dx, and p = 0 at x = a
    const double middle = 500.0 * (now.rate * now.rate - change) * now.a * now.a;
    Snapshot frame;
    frame.time = time;
    frame.position = s.initial.position;
    const auto at = [&](double x, double y) {
      frame.position[0] = {0.5 + x, 0.5 + y, 0};
      return drop->truth_for(frame);
    };
    EXPECT_NEAR(at(0, 0).pressure[0], middle, 1e-3 * middle) << time;  // of a difference over 1e-4 s
    const double p0 = at(0, 0).pressure[0];
    EXPECT_NEAR(at(0.5 * now.a, 0).pressure[0], 0.75 * p0, 1e-9 * p0);
    EXPECT_NEAR(at(0, 0.5 * now.b).pressure[0], 0.75 * p0, 1e-9 * p0);
    EXPECT_NEAR(at(0.3 * now.a, -0.4 * now.b).pressure[0], 0.75 * p0, 1e-9 * p0);
    EXPECT_EQ(at(1.01 * now.a, 0).pressure[0], 0.0);
    EXPECT_EQ(at(0, 1.01 * now.b).pressure[0], 0.0);
    expect_near(at(0.1, 0.2).velocity[0], {-0.1 * now.rate, 0.2 * now.rate, 0.0}, 1e-12, "drawn out");
  }
  EXPECT_NEAR(*drop->number("half_length"), elliptic_drop(2.0, 0.5, 0.2).b, 1e-12);
  EXPECT_EQ(drop->measuring().axis, 1u);
}

TEST(KnownLiquids, AtTheWallsALiquidMovesAsTheyDo) {
  const ShearFlow f{2.0, 0.01, 0.3, -1.0, 4.0};
  EXPECT_EQ(f.speed(0.0, 0.0), -1.0);
  EXPECT_EQ(f.speed(-0.1, 0.0), -1.0);
  EXPECT_EQ(f.speed(2.0, 0.0), 4.0);
  EXPECT_EQ(f.speed(2.1, 0.0), 4.0);
  EXPECT_EQ(f.speed(1.0, 0.0), 0.0);
  EXPECT_EQ(f.speed(1e-9, 0.0), 0.0);
  EXPECT_NEAR(f.speed(0.0, 3.0), -1.0, 1e-12);
  EXPECT_NEAR(f.speed(2.0, 3.0), 4.0, 1e-12);
  EXPECT_NEAR(f.speed(0.5, 1e5), 0.5 * 30.0 * 0.5 * 1.5 - 1.0 + 5.0 * 0.25, 1e-9);
}

TEST(KnownLiquids, BetweenCylindersTheTorqueIsThatOfTheirRadii) {
  auto s = test::channel({}, {2, 0, 0});
  s.job.scene.periodic[2] = true;
  s.job.bodies[2].angular_velocity = {0, 0, 1.5};
  const auto flow = made(s, "couette_cylinders", {{"inner_radius", 0.2}, {"outer_radius", 0.4}});
  // u = A r + B/r, u(0.4) = 0, u(0.2) = 0.3: B = 0.08, A = -0.5; -4 pi mu B L
  EXPECT_NEAR(*flow->number("torque"), -4.0 * pi * 10.0 * 0.08 * 3.0, 1e-9);
  Snapshot now;
  now.position = s.initial.position;
  const Vec3 centre = s.job.bodies[2].properties.centre;
  for (const auto& [r, u] : {std::pair{0.2, 0.3}, std::pair{0.4, 0.0}, std::pair{0.25, 0.195}}) {
    now.position[0] = centre + Vec3{r, 0, 0};
    now.position[1] = centre + Vec3{0, r, 0.5};
    expect_near(flow->truth_for(now).velocity[0], {0, u, 0}, 1e-12, "along x");
    expect_near(flow->truth_for(now).velocity[1], {-u, 0, 0}, 1e-12, "along y");
  }
}

TEST(KnownLiquids, SoundIsAQuarterPeriodFromSpeedToPressure) {
  const auto s = test::swinging(test::sound_start(), 10);
  const auto wave = made(s, "sound_wave", {{"sound_speed", 5.0}});
  EXPECT_NEAR(*wave->number("frequency"), 10.0 * pi, 1e-12);
  Snapshot now;
  now.position = s.initial.position;
  now.position[0].x = -0.7 / (2.0 * pi);
  now.position[1].x = (0.5 * pi - 0.7) / (2.0 * pi);  // phases 0 and pi/2
  const auto start = wave->truth_for(now);
  EXPECT_NEAR(start.velocity[0].x, 0.01, 1e-15);
  EXPECT_NEAR(start.velocity[1].x, 0.0, 1e-15);
  EXPECT_NEAR(start.pressure[1], 0.0, 1e-12);
  now.time = 0.05;
  const auto quarter = wave->truth_for(now);
  EXPECT_NEAR(quarter.velocity[0].x, 0.0, 1e-15);
  EXPECT_NEAR(quarter.pressure[0], 0.0, 1e-12);
  EXPECT_NEAR(quarter.pressure[1], 1000.0 * 5.0 * 0.01, 1e-10);  // rho c v
  EXPECT_NEAR(quarter.density[1], 1002.0, 1e-10);
}

TEST(KnownLiquids, ABallTurnsAsABodyAtItsStart) {
  auto s = test::swinging({}, 10, 2.0);
  auto& body = s.job.scene.bodies[0];
  body.shape.kind = Shape::Kind::sphere;
  body.shape.centre = {0.5, 0, 0};
  body.shape.radius = 0.5;
  body.angular_velocity = {0, 0, 3};
  Snapshot now;
  now.position = s.initial.position;
  now.position[0] = {0.7, 0.1, 0};
  expect_near(made(s, "liquid_ball")->truth_for(now).velocity[0], {-0.3, 0.6, 0}, 1e-14, "w x r");
  now.time = 0.1;
  EXPECT_TRUE(made(s, "liquid_ball")->truth_for(now).velocity.empty());
  EXPECT_EQ(made(s, "liquid_ball")->number("spin_rate"), 0.0);
  EXPECT_NEAR(*made(s, "liquid_ball", {{"form", std::string("paper")}})->number("spin_rate"),
              5.0 * 0.002 / 0.25, 1e-15);
}

TEST(KnownLiquids, AColumnsFrontIsKnownAtNineteenTimes) {
  auto s = test::pool(350.0);
  test::set_times(s, 0.2, 4);
  auto& box = s.job.scene.bodies[0].shape;
  box.min = {0.25, 0, 0};
  box.max = {0.75, 1, 0.5};
  const auto column = made(s, "collapsing_column", {{"cells", 4.0}});
  const auto* front = column->measured("front");
  ASSERT_NE(front, nullptr);
  EXPECT_EQ(column->measured("top"), nullptr);
  ASSERT_EQ(front->time.size(), 19u);
  EXPECT_NEAR(front->time[0], 0.01, 1e-15);
  EXPECT_NEAR(front->time[18], 0.19, 1e-15);
  EXPECT_NEAR(front->value[0], 0.75, 1e-3);
  for (std::size_t n = 1; n < 19; ++n) EXPECT_GT(front->value[n], front->value[n - 1]);
  EXPECT_EQ(column->measuring().axis, 0u);
}

// --- bodies

TEST(KnownBodies, ABoxBouncesWhicheverWayIsUp) {
  for (const double up : {1.0, -1.0}) {
    Prepared s;
    s.job.scene.spacing = 0.1;
    s.job.scene.gravity = {0, 0, -10.0 * up};
    test::add_body(s, "block", {{4, 4, 4}, 0.1, {0, 0, up > 0.0 ? 0.2 : -0.6}, 2.0}, {});
    test::add_body(s, "floor", {{8, 8, 1}, 0.1, {-0.2, -0.2, up > 0.0 ? -0.1 : 0.0}, 1.0}, {}, Motion::fixed);
    s.job.bodies[0].velocity = {0, 0, 3.0 * up};
    test::set_times(s, 1.0, 4);
    EXPECT_NEAR(made(s, "resting")->at(0.7).bodies[0].position.z, 0.2 * up, 1e-14);
    const auto bounce = made(s, "bouncing", {{"restitution", 0.5}});
    const double touch = (3.0 + std::sqrt(9.0 + 4.0)) / 10.0, hit = std::sqrt(13.0);
    EXPECT_NEAR(*bounce->number("touch_time"), touch, 1e-14);
    const auto height = [&](double t) { return up * bounce->at(t).bodies[0].position.z - 0.2; };
    const auto speed = [&](double t) { return up * bounce->at(t).bodies[0].velocity.z; };
    EXPECT_NEAR(height(0.0), 0.2, 1e-14);
    EXPECT_NEAR(height(0.3), 0.2 + 0.45, 1e-14);
    EXPECT_NEAR(speed(touch), -hit, 1e-12);
    EXPECT_NEAR(speed(touch + 1e-9), 0.5 * hit, 1e-7);
    EXPECT_NEAR(height(touch + 0.05 * hit), 0.0125 * 13.0, 1e-12);  // (hit/2)^2/(2 g)
    EXPECT_EQ(bounce->at(9.0).bodies[0].velocity.z, 0.0);
    EXPECT_EQ(bounce->measuring().axis, 2u);
  }
}

TEST(KnownBodies, TwoCubesChangeTheirSpeedsWhereTheyTouch) {
  for (const bool swapped : {false, true}) {
    Prepared t;
    t.job.scene.spacing = 0.1;
    const auto left = [&] {
      test::add_matter(t, "left", Phase::rigid, {{4, 4, 4}, 0.1, {-0.6, 0, 0}, 1.0}, {{1, 0, 0}, {}}, 1000.0);
    };
    const auto right = [&] {
      test::add_matter(t, "right", Phase::rigid, {{4, 4, 4}, 0.1, {0.2, 0, 0}, 1.0}, {{-0.5, 0, 0}, {}},
                       3000.0);
    };
    if (swapped) {
      right();
      left();
    } else {
      left();
      right();
    }
    test::set_times(t, 1.0, 10);
    const auto hit = made(t, "elastic_collision");
    EXPECT_NEAR(*hit->number("event_time"), 0.4 / 1.5, 1e-14);
    EXPECT_NEAR(*hit->number("touch_time"), 0.4 / 1.5, 1e-14);
    const std::size_t a = swapped ? 1 : 0, b = 1 - a;
    const auto before = hit->at(0.1), after = hit->at(0.4 / 1.5 + 0.4);
    EXPECT_NEAR(before.bodies[a].velocity.x, 1.0, 1e-15);
    EXPECT_NEAR(before.bodies[a].position.x, -0.4 + 0.1, 1e-14);
    EXPECT_NEAR(after.bodies[a].velocity.x, -1.25, 1e-14);  // the centre of mass goes at (1 - 1.5)/4
    EXPECT_NEAR(after.bodies[b].velocity.x, 0.25, 1e-14);
    EXPECT_NEAR(after.bodies[a].position.x, -0.4 + 0.4 / 1.5 - 1.25 * 0.4, 1e-14);
    EXPECT_NEAR(after.bodies[b].position.x, 0.4 - 0.2 / 1.5 + 0.25 * 0.4, 1e-14);
  }
}

TEST(KnownBodies, TheLawsOfConservationKnowMassMomentumAndEnergy) {
  auto s = test::cubes();
  s.job.scene.gravity = {0, 0, -10};
  const auto laws = made(s, "invariant");
  EXPECT_NEAR(*laws->number("mass"), 256.0, 1e-10);
  EXPECT_NEAR(*laws->number("kinetic_energy"), 0.5 * 64.0 + 0.5 * 192.0 * 0.25, 1e-10);
  EXPECT_NEAR(laws->at(0.5).total_mass, 256.0, 1e-10);
  expect_near(laws->at(0.5).momentum, {64.0 - 96.0, 0, -1280.0}, 1e-9, "m v + m g t");
  EXPECT_TRUE(laws->at(0.5).position.empty());
}

}  // namespace
}  // namespace tripoint
