// SPDX-License-Identifier: BSD-3-Clause
// Digits of the IFToMM library and of other formulations, to the places that they are known to.
#include <gtest/gtest.h>

#include <cmath>

#include "references/scenes.hpp"
#include "validation/references/jointed_motion.hpp"

namespace tripoint {
namespace {

struct Machine {
  Job job;
  explicit Machine(const Vec3& gravity) { job.scene.gravity = gravity; }

  /// @param moments about x, y, z through the centre [kg m2]
  JobBody& add(const std::string& name, double mass, const Vec3& centre, const Vec3& moments) {
    JobBody b;
    b.name = name;
    b.index = static_cast<int>(job.bodies.size());
    b.properties = {mass, centre, moments, {}};
    job.bodies.push_back(b);
    return job.bodies.back();
  }
  /// A uniform rod of 1 kg along an axis; `thick`: moment about itself, and what it adds to the others [kg
  /// m2].
  JobBody& rod(const std::string& name, const Vec3& from, const Vec3& to, double about_itself,
               double across) {
    Vec3 moments{across, across, across};
    for (std::size_t k = 0; k < 3; ++k)
      if (from[k] != to[k]) moments[k] = about_itself;
    return add(name, 1.0, 0.5 * (from + to), moments);
  }
  void join(Joint::Kind kind, const std::string& a, const std::string& b, const Vec3& place,
            std::optional<Vec3> axis = {}) {
    Joint j;
    j.name = a + b;
    j.kind = kind;
    j.bodies = {a, b};
    j.point = place;
    j.axis = axis;
    job.scene.joints.push_back(j);
  }
  /// Where a point of a body is.
  [[nodiscard]] Vec3 place(const JointedMotion& motion, std::size_t body, const Vec3& at_start,
                           double t) const {
    const BodyState b = motion.at(t).at(body);
    return b.position + rotate(b.orientation, at_start - job.bodies[body].properties.centre);
  }
};

using Kind = Joint::Kind;
const Vec3 along_y{0, 1, 0}, down{0, 0, -9.81};
constexpr double thin = 1.0 / 12.0;

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

/// A rod of 1.5 m swings as a point at 1 m.
TEST(Jointed, PlanarPendulumHasItsDigits) {
  Machine m(down);
  m.add("rod", 1.0, {-0.75, 0, 0}, {1e-3, 0.1875, 0.1875});
  m.join(Kind::hinge, "rod", "world", {}, along_y);
  const JointedMotion motion(m.job);
  expect_near(m.place(motion, 0, {-1, 0, 0}, 1.0), {0.986291751, 0, -0.165010853}, 1e-9);
  expect_near(m.place(motion, 0, {-1, 0, 0}, 5.0), {-0.942305435, 0, -0.334754338}, 1e-9);
  expect_near(m.place(motion, 0, {-1, 0, 0}, 10.0), {-0.275087463, 0, -0.961419205}, 1e-9);
}

TEST(Jointed, DoublePendulumHasItsDigitsToFiveSeconds) {
  Machine m(down);
  m.rod("upper", {}, {1, 0, 0}, 1e-3, thin);
  m.rod("lower", {1, 0, 0}, {2, 0, 0}, 1e-3, thin);
  m.join(Kind::hinge, "upper", "world", {}, along_y);
  m.join(Kind::hinge, "lower", "upper", {1, 0, 0}, along_y);
  const JointedMotion motion(m.job);
  expect_near(m.place(motion, 1, {2, 0, 0}, 2.0), {0.313524776, 0, -1.914746618}, 2e-9);
  expect_near(m.place(motion, 1, {2, 0, 0}, 5.0), {1.855221938, 0, -0.739567933}, 1e-8);
}

TEST(Jointed, LoopsPassTheirSingularPlace) {
  Machine m(down);
  for (int k = 0; k < 3; ++k) {
    JobBody& b = m.rod("crank" + std::to_string(k), {double(k), 0, 0}, {double(k), 0, 1}, 1e-3, thin);
    b.velocity = {0.5, 0, 0};
    b.angular_velocity = along_y;
  }
  for (int k = 0; k < 2; ++k)
    m.rod("top" + std::to_string(k), {double(k), 0, 1}, {k + 1.0, 0, 1}, 1e-3, thin).velocity = {1, 0, 0};
  for (int k = 0; k < 3; ++k)
    m.join(Kind::hinge, "crank" + std::to_string(k), "world", {double(k), 0, 0}, along_y);
  for (int k = 0; k < 2; ++k)
    for (int side = 0; side < 2; ++side)
      m.join(Kind::hinge, "top" + std::to_string(k), "crank" + std::to_string(k + side),
             {double(k + side), 0, 1}, along_y);
  const JointedMotion motion(m.job);
  expect_near(m.place(motion, 0, {0, 0, 1}, 2.0), {0.057815796, 0, 0.998327268}, 1e-8);
  expect_near(m.place(motion, 0, {0, 0, 1}, 5.0), {-0.811310461, 0, -0.584615545}, 1e-8);
}

/// Six hinges of a loop: 30 rows for 30 freedoms, and it moves.
TEST(Jointed, BricardMovesByItsRedundantRows) {
  Machine m({0, -9.81, 0});
  const std::vector<Vec3> corner{{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  const std::vector<Vec3> axis{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  for (std::size_t k = 0; k < 5; ++k)
    m.rod("rod" + std::to_string(k), corner[k], corner[k + 1], 0.02 / 12, 1.01 / 12);
  for (std::size_t k = 0; k < 6; ++k)
    m.join(Kind::hinge, "rod" + std::to_string(std::min<std::size_t>(k, 4)),
           k == 0 || k == 5 ? "world" : "rod" + std::to_string(k - 1), corner[k], axis[k]);
  const JointedMotion motion(m.job);
  expect_near(m.place(motion, 2, corner[3], 0.5), {0.96828368, -1.22462516, 0.75014661}, 1e-8);
  expect_near(m.place(motion, 2, corner[3], 2.0), {-0.96934034, -1.22124689, 0.75427801}, 1e-7);
}

TEST(Jointed, HeavyTopHasItsDigits) {
  Machine m(down);
  JobBody& top = m.add("top", 15.0, {0, 1, 0}, {0.234375, 0.46875, 0.234375});
  top.angular_velocity = {0, 150, -4.61538};
  top.velocity = {4.61538, 0, 0};
  m.join(Kind::ball, "top", "world", {});
  const JointedMotion motion(m.job);
  expect_near(motion.at(0.5)[0].position, {-0.70246830, -0.02116518, -0.71140026}, 1e-8);
  expect_near(motion.at(1.0)[0].position, {0.17334396, 0.64008859, -0.74849079}, 1e-8);
}

/// A slider's spring: x = -(g sin a/omega^2) (1 - cos omega t); and a damper, whose rate is known too.
TEST(Jointed, SpringAndDamperActAlongTheCoordinate) {
  Machine m(down);
  m.add("block", 2.0, {}, {0.1, 0.1, 0.1});
  m.join(Kind::slider, "block", "world", {}, Vec3{std::sqrt(0.75), 0, 0.5});
  m.job.scene.joints[0].spring = JointSpring{50.0, 0.0};
  const double omega = 5.0, rest = -9.81 * 0.5 / 25.0;
  const Vec3 at = JointedMotion(m.job).at(0.7)[0].position;
  EXPECT_NEAR(norm(at), std::abs(rest * (1.0 - std::cos(omega * 0.7))), 1e-10);
  m.job.scene.joints[0].damping = 4.0;  // 1/s by the mass: c/2m = 1
  const double damped = std::sqrt(24.0), t = 0.7;
  const double way = rest * (1.0 - std::exp(-t) * (std::cos(damped * t) + std::sin(damped * t) / damped));
  EXPECT_NEAR(norm(JointedMotion(m.job).at(t)[0].position), std::abs(way), 1e-10);
}

/// A fixed joint makes one body of two: their common spin is that of a free top.
TEST(Jointed, EachKindLeavesItsFreedoms) {
  Machine m({0, 0, 0});
  m.add("a", 1.0, {-0.5, 0, 0}, {0.1, 0.2, 0.3}).angular_velocity = {0, 0, 1};
  m.add("b", 1.0, {0.5, 0, 0}, {0.1, 0.2, 0.3}).angular_velocity = {0, 0, 1};
  m.job.bodies[0].velocity = {0, -0.5, 0};
  m.job.bodies[1].velocity = {0, 0.5, 0};
  m.join(Kind::fixed, "a", "b", {});
  const auto turned = JointedMotion(m.job).at(1.0);
  EXPECT_NEAR(angle_between(turned[0].orientation, from_rotation_vector({0, 0, 1})), 0.0, 1e-10);
  expect_near(turned[1].position, {0.5 * std::cos(1.0), 0.5 * std::sin(1.0), 0}, 1e-10);
  m.job.scene.joints[0].kind = Kind::distance;
  m.job.scene.joints[0].point = {-0.5, 0, 0};
  m.job.scene.joints[0].other_point = Vec3{0.5, 0, 0};
  m.job.bodies[0].angular_velocity = {0, 0, 3};  // about itself: a distance does not hold it
  const auto tied = JointedMotion(m.job).at(1.0);
  EXPECT_NEAR(norm(tied[0].position - tied[1].position), 1.0, 1e-12);
  EXPECT_NEAR(angle_between(tied[0].orientation, from_rotation_vector({0, 0, 3})), 0.0, 1e-10);
}

/// A block of 2 kg on a level rail: F = 4 N stops 2 m/s in 1 s, after v^2 m/(2 F) = 1 m.
TEST(Jointed, FrictionStopsAndHolds) {
  Machine m({0, 0, -1});
  m.add("block", 2.0, {}, {0.1, 0.1, 0.1}).velocity = {2, 0, 0};
  m.join(Kind::slider, "block", "world", {}, Vec3{1, 0, 0});
  m.job.scene.joints[0].friction = 4.0;
  const JointedMotion motion(m.job);
  EXPECT_NEAR(motion.at(0.5)[0].position.x, 0.75, 1e-10);
  EXPECT_NEAR(motion.at(3.0)[0].position.x, 1.0, 1e-10);
  EXPECT_NEAR(motion.at(3.0)[0].velocity.x, 0.0, 1e-10);
}

/// A spring of 50 N/m that is 0.4 m from its rest, 2 kg and 3 N of friction: each half swing of pi/5 s ends
/// 2 F/k nearer to the rest, at -0.28 and 0.16 m, and it stays within F/k: at 0.04 m.
TEST(Jointed, FrictionTurnsWithTheRate) {
  Machine m({0, 0, 0});
  m.add("block", 2.0, {}, {0.1, 0.1, 0.1});
  m.join(Kind::slider, "block", "world", {}, Vec3{1, 0, 0});
  m.job.scene.joints[0].spring = JointSpring{50.0, 0.4};
  m.job.scene.joints[0].friction = 3.0;
  const JointedMotion motion(m.job);
  const double half = std::acos(-1.0) / 5.0;
  const auto from_rest = [&](double t) { return motion.at(t)[0].position.x - 0.4; };
  EXPECT_NEAR(from_rest(half), 0.28, 1e-9);
  EXPECT_NEAR(from_rest(1.5 * half), 0.06, 1e-9);
  EXPECT_NEAR(from_rest(2.0 * half), -0.16, 1e-9);
  EXPECT_NEAR(from_rest(3.0 * half), 0.04, 1e-9);
  EXPECT_NEAR(from_rest(5.0), 0.04, 1e-9);
}

/// A fall of 0.5 m onto a limit with a restitution of 0.5, then a quarter of the height, and so on to rest.
TEST(Jointed, LimitsThrowBackAndHold) {
  Machine m({0, 0, -10});
  m.add("block", 2.0, {}, {0.1, 0.1, 0.1});
  m.join(Kind::slider, "block", "world", {}, Vec3{0, 0, 1});
  m.job.scene.joints[0].limits = {-0.5, 1.0};
  m.job.scene.joints[0].restitution = 0.5;
  const double fall = std::sqrt(0.1), speed = std::sqrt(10.0);
  const JointedMotion motion(m.job);
  EXPECT_NEAR(motion.at(fall + 0.05 * speed)[0].position.z, -0.5 + 0.5 * 0.25, 1e-9);
  EXPECT_NEAR(motion.at(fall * (1.0 + 1.0 + 0.25))[0].position.z, -0.5 + 0.5 * 0.25 * 0.25, 1e-9);
  EXPECT_NEAR(motion.at(1.5)[0].position.z, -0.5, 1e-9);
  m.job.scene.joints[0].restitution = 0.0;
  EXPECT_NEAR(JointedMotion(m.job).at(fall + 0.1)[0].position.z, -0.5, 1e-10);
}

/// A leg swings until its knee is straight, and goes on as one rod: two rods of 1 m as one of 2 m.
TEST(Jointed, AHitReachesBodiesThroughTheirJoints) {
  Machine m({0, 0, 0});
  m.rod("upper", {}, {1, 0, 0}, 1e-3, thin).angular_velocity = {0, 1, 0};
  m.job.bodies[0].velocity = {0, 0, -0.5};
  m.rod("lower", {1, 0, 0}, {2, 0, 0}, 1e-3, thin).velocity = {0, 0, -1};
  m.join(Kind::hinge, "upper", "world", {}, along_y);
  m.join(Kind::hinge, "lower", "upper", {1, 0, 0}, along_y);
  m.job.scene.joints[1].limits = {0.0, 1.0};  // lower has no spin, and so hits at the start
  // L about the origin: 1/3 of the upper, 1 kg 1 m/s at 1.5 m of the lower; together 8/3 kg m2
  EXPECT_NEAR(JointedMotion(m.job).at(0.0)[0].angular_velocity.y, (1.0 / 3.0 + 1.5) / (8.0 / 3.0), 1e-12);
  EXPECT_NEAR(JointedMotion(m.job).at(0.3)[1].angular_velocity.y, (1.0 / 3.0 + 1.5) / (8.0 / 3.0), 1e-10);
}

/// Seven bodies of grams, three loops: the angle of the crank, to the digits of the IVP test set of Bari.
TEST(Jointed, SqueezerHasItsDigits) {
  Machine m({0, 0, 0});
  const Vec3 z{0, 0, 1};
  m.add("k1", 0.04325, {0.00091824859803076139, -5.6740745629054792e-05, 0},
        {2.194e-06, 2.194e-06, 2.194e-06});
  m.add("k2", 0.00365, {-0.0044914333599330725, 0.00027753625579428966, 0}, {4.41e-07, 4.41e-07, 4.41e-07});
  m.add("k3", 0.02373, {-0.018742186670315464, 0.020485106789073927, 0}, {5.255e-06, 5.255e-06, 5.255e-06});
  m.add("k4", 0.00706, {-0.03022293983015889, 0.012071182356663959, 0}, {5.667e-07, 5.667e-07, 5.667e-07});
  m.add("k5", 0.0705, {-0.053236828155704151, 0.016631847966616313, 0}, {1.169e-05, 1.169e-05, 1.169e-05});
  m.add("k6", 0.00706, {-0.028543268536783604, -0.010722254707252295, 0}, {5.667e-07, 5.667e-07, 5.667e-07});
  m.add("k7", 0.05498, {-0.059262402801791715, -0.010600698332712846, 0}, {1.912e-05, 1.912e-05, 1.912e-05});
  m.join(Kind::hinge, "k1", "world", {0, 0, 0}, z);
  m.join(Kind::hinge, "k2", "k1", {0.0069866741154514453, -0.00043172306456889517, 0}, z);
  m.join(Kind::hinge, "k3", "k2", {-0.020960022346354336, 0.0012951691937066856, 0}, z);
  m.join(Kind::hinge, "k4", "k2", {-0.020960022346354336, 0.0012951691937066856, 0}, z);
  m.join(Kind::hinge, "k6", "k2", {-0.020960022346354336, 0.0012951691937066856, 0}, z);
  m.join(Kind::hinge, "k3", "world", {-0.03635, 0.032730000000000002, 0}, z);
  m.join(Kind::hinge, "k5", "k4", {-0.033997203885839988, 0.016461971674997699, 0}, z);
  m.join(Kind::hinge, "k7", "k6", {-0.0316331345074089, -0.015618868668304543, 0}, z);
  m.join(Kind::hinge, "k5", "world", {-0.069339999999999999, -0.0022699999999999999, 0}, z);
  m.join(Kind::hinge, "k7", "world", {-0.069339999999999999, -0.0022699999999999999, 0}, z);
  m.job.scene.joints[0].motor = JointMotor{0.033, {}};
  Spring spring;
  spring.body = "k3";
  spring.other = "world";
  spring.point = {-0.010472393888814626, 0.025357788530275243, 0};
  spring.other_point = {0.014, 0.072, 0};
  spring.stiffness = 4530.0;
  spring.length = 0.07785;
  m.job.scene.springs.push_back(spring);
  const JointedMotion motion(m.job);
  const auto turned = [&](double t) {
    const Quaternion q = motion.at(t)[0].orientation;
    return 2.0 * std::atan2(q.z, q.w);
  };
  constexpr double start = -0.0617138900142764;
  EXPECT_NEAR(turned(0.005), 0.2110763859 - start, 1e-9);
  EXPECT_NEAR(turned(0.01), 2.1601131315 - start, 2e-9);
}

TEST(Jointed, RefusesWhatItDoesNotKnow) {
  Machine m(down);
  m.add("rod", 1.0, {-0.75, 0, 0}, {1e-3, 0.1875, 0.1875});
  m.join(Kind::hinge, "rod", "world", {}, along_y);
  m.job.scene.joints[0].limits = {-4.0, 0.1};
  EXPECT_THROW(JointedMotion{m.job}, InputError);
}

}  // namespace
}  // namespace tripoint
