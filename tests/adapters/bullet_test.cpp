// SPDX-License-Identifier: BSD-3-Clause
// Bullet's own error is part of every row that it fills: these tests state it, and that the adapter adds
// none.
#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>
#include <gtest/gtest.h>

#include "adapters/bullet/bullet_engine.hpp"
#include "adapters/bullet/presets.hpp"
#include "adapters/scenes.hpp"
#include "scene/motion.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

using bullet::BulletEngine;
using test::Prepared;

std::vector<Snapshot> fly(const Prepared& p) {
  BulletEngine engine;
  EXPECT_EQ(engine.refusal(p.job), "");
  engine.load(p.job, p.initial);
  std::vector<Snapshot> frames;
  for (const double t : p.job.times) {
    if (t > p.job.times.front()) engine.advance_to(t);
    frames.push_back(engine.observe());
  }
  return frames;
}

double energy(const Snapshot& s) { return s.energy.at("kinetic"); }

TEST(Bullet, FallsAsSemiImplicitEulerDoes) {
  const double dt = 0.01;
  const Vec3 g{0.3, 0.0, -9.81}, v{1.0, 0.0, 5.0};
  const Prepared p = test::block({v, {}}, g, 1.0, 4, dt);
  for (const Snapshot& s : fly(p)) {
    // The velocity is stepped first: a lag of g dt t/2
    const Vec3 exact = s.time * v + (0.5 * s.time * (s.time + dt)) * g;
    EXPECT_LT(norm(s.bodies[0].position - p.job.bodies[0].properties.centre - exact), 1e-13)
        << "round-off of 100 steps";
    EXPECT_LT(norm(s.bodies[0].velocity - v - s.time * g), 1e-13);
  }
}

TEST(Bullet, HitsOutputTimesThatAreNoMultipleOfItsStep) {
  const Vec3 g{0, 0, -9.81};
  const Prepared p = test::block({{}, {}}, g, 1.0, 3, 0.07);  // 5 steps of 1/15 s an interval
  const auto frames = fly(p);
  EXPECT_EQ(frames.back().step, 15);
  EXPECT_NEAR(frames.back().bodies[0].position.z, 0.5 * (1.0 + 1.0 / 15.0) * g.z, 1e-13);
}

double torque_free_error(double dt) {
  const Vec3 w{1, 2, 3};
  const Prepared p = test::block({{}, w}, {}, 2.0, 1, dt);
  const auto& m = p.job.bodies[0].properties;
  return angle_between(fly(p).back().bodies[0].orientation,
                       TorqueFree(m.principal_inertia, m.principal_axes, w).rotation(2.0));
}

TEST(Bullet, TurnsAnAsymmetricBodyToFirstOrder) {
  const double coarse = torque_free_error(2e-3), fine = torque_free_error(1e-3);
  EXPECT_GT(fine, 1e-4) << "it is no reference for rotation";
  EXPECT_NEAR(coarse / fine, 2.0, 0.1) << "order 1; the second-order term is a few per cent at these steps";
}

TEST(Bullet, KeepsASteadySpinToRoundOff) {
  Scene s;
  s.spacing = 0.1;
  s.materials = {test::material(15.625)};
  const Vec3 w = 7.0 / std::sqrt(14.0) * Vec3{1, 2, 3};
  s.bodies = {test::rigid("cube", test::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}), {{}, w})};
  Prepared p = test::prepare(s, 1.0, 2);
  p.job.resolution.time_step = 0.01;
  EXPECT_LT(angle_between(fly(p).back().bodies[0].orientation, from_rotation_vector(w)), 1e-12);
}

/// Two spheres of 1:2 in density head-on along x, of relative speed 1.5.
Prepared head_on(double restitution, double dt) {
  Scene s;
  s.spacing = 0.05;
  s.materials = {test::material(1000.0), test::material(2000.0)};
  s.materials[1].name = "heavy";
  s.bodies = {test::rigid("light", test::sphere({0, 0, 0}, 0.1), {{1.0, 0, 0}, {}}),
              test::rigid("heavy", test::sphere({0.41, 0, 0}, 0.1), {{-0.5, 0, 0}, {}})};
  s.bodies[1].material = "heavy";
  Prepared p = test::prepare(s, 0.5, 1);
  p.job.preset = "impact";
  p.job.settings["restitution"] = restitution;
  p.job.resolution.time_step = dt;
  return p;
}

TEST(Bullet, ImpactPresetIsExactForACentralHitAtAnyStep) {
  for (const double e : {0.0, 0.5, 1.0})
    for (const double dt : {1.0 / 60.0, 1e-3}) {
      const Prepared p = head_on(e, dt);
      const double m1 = p.job.bodies[0].properties.mass, m2 = p.job.bodies[1].properties.mass,
                   mean = (m1 - 0.5 * m2) / (m1 + m2);
      const Snapshot after = fly(p).back();
      EXPECT_NEAR(after.bodies[0].velocity.x, mean - e * 1.5 * m2 / (m1 + m2), 1e-12)
          << "e = " << e << ", dt = " << dt;
      EXPECT_NEAR(after.bodies[1].velocity.x, mean + e * 1.5 * m1 / (m1 + m2), 1e-12);
    }
}

Prepared two_tumbling() {
  Scene s;
  s.spacing = 0.1;
  s.materials = {test::material(15.625)};
  s.bodies = {
      test::rigid("cube", test::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}), {{1, 0, 0}, {1, 2, 0}}),
      test::rigid("bar", test::box({0.8, -0.1, -0.25}, {1.1, 0.2, 0.25}), {{-1, 0.2, 0}, {0, -1, 3}})};
  return test::prepare(s, 0.02, 2);
}

TEST(Bullet, MergesWithTheMomentaOfBoth) {
  Prepared p = two_tumbling();
  Event merge;
  merge.time = 0.01;
  merge.bodies = {"cube", "bar"};
  BulletEngine apart, joined;
  apart.load(p.job, p.initial);
  p.job.scene.events = {merge};
  joined.load(p.job, p.initial);
  apart.advance_to(0.01);
  joined.advance_to(0.01);
  const Snapshot before = apart.observe(), after = joined.observe();
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-14);
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-14);
  EXPECT_LT(energy(after), 0.2 * energy(before));
  EXPECT_TRUE(std::isnan(after.bodies[1].mass));
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    EXPECT_LT(norm(after.position[i] - before.position[i]), 1e-14);
}

TEST(Bullet, SplitsWithoutLosingMomentumOrEnergy) {
  Prepared p = test::block({{0.3, 0, 0}, {1, 2, 3}}, {}, 0.02, 2, 1e-3);
  Event split;
  split.kind = Event::Kind::split;
  split.time = 0.01;
  split.name = "piece";
  split.region = Shape{};
  split.region->kind = Shape::Kind::half_space;
  split.region->normal = {0, 0, 1};
  BulletEngine whole, parted;
  whole.load(p.job, p.initial);
  p.job.scene.events = {split};
  parted.load(p.job, p.initial);
  whole.advance_to(0.01);
  parted.advance_to(0.01);
  const Snapshot before = whole.observe(), after = parted.observe();
  ASSERT_EQ(after.bodies.size(), 2U);
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-14);
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-14);
  EXPECT_NEAR(energy(after), energy(before), 1e-14);
  EXPECT_LT(angle_between(after.bodies[1].orientation, {}), 1e-15) << "(1,0,0,0) at birth";
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    EXPECT_LT(norm(after.velocity[i] - before.velocity[i]), 1e-13);
}

TEST(Bullet, PutsAPrescribedBodyWhereItsKeyframesSay) {
  Scene s;
  s.spacing = 0.1;
  s.materials = {test::material(700.0)};
  s.bodies = {test::rigid("board", test::box({-0.5, -0.3, -0.1}, {0.5, 0.3, 0.1}), {}, Motion::prescribed)};
  s.bodies[0].keyframes = {{0.0, {}, {}}, {1.0, {0.5, 0, 0.2}, from_rotation_vector({0, 0.7, 0})}};
  const Prepared p = test::prepare(s, 1.0, 3);
  for (const Snapshot& f : fly(p)) {
    const auto expected =
        prescribed_state(s.bodies[0].keyframes, p.job.bodies[0].properties.centre, {}, {}, f.time);
    EXPECT_LT(norm(f.bodies[0].position - expected.position), 1e-14);
    EXPECT_LT(angle_between(f.bodies[0].orientation, expected.rotation), 1e-12);
    EXPECT_LT(norm(f.bodies[0].angular_velocity - expected.angular_velocity), 1e-9)
        << "Bullet's own difference over a step";
  }
}

TEST(Bullet, KeepsACollinearBodyFinite) {
  Scene s;
  s.spacing = 0.1;
  s.materials = {test::material(1000.0)};
  s.bodies = {test::rigid("needle", test::box({0, 0, 0}, {0.5, 0.1, 0.1}), {{}, {0, 0, 1}})};
  const Prepared p = test::prepare(s, 2.0, 2);
  const Snapshot after = fly(p).back();
  EXPECT_LT(norm(after.bodies[0].angular_velocity - Vec3{0, 0, 1}), 1e-9)
      << "a line turns about its short axis for ever, though its least moment is 0";
}

/// A block of 4 x 4 x 2 on a floor.
Prepared on_floor(double friction, const Vec3& velocity, const Vec3& gravity) {
  Scene s;
  s.spacing = 0.1;
  s.gravity = gravity;
  s.materials = {test::material(1000.0)};
  s.bodies = {test::rigid("block", test::box({0, -0.2, 0}, {0.4, 0.2, 0.2}), {velocity, {}}),
              test::rigid("floor", test::box({-1, -0.5, -0.2}, {3, 0.5, 0}), {}, Motion::fixed)};
  Prepared p = test::prepare(s, 0.5, 5);
  p.job.preset = "resting";
  p.job.settings["friction"] = friction;
  p.job.resolution.time_step = 1e-3;
  return p;
}

TEST(Bullet, BrakesABlockByFriction) {
  for (const double mu : {0.0, 0.1, 0.3}) {
    const double v = fly(on_floor(mu, {2, 0, 0}, {0, 0, -9.81})).back().bodies[0].velocity.x;
    EXPECT_NEAR(v, 2.0 - mu * 9.81 * 0.5, 5e-4) << "mu = " << mu;
  }
}

TEST(Bullet, HoldsABlockOnASlopeThatIsNotSteeperThanItsFriction) {
  // 20 degrees, whose tangent is 0.364
  const Vec3 g{9.81 * std::sin(0.349066), 0, -9.81 * std::cos(0.349066)};
  EXPECT_LT(std::abs(fly(on_floor(0.38, {}, g)).back().bodies[0].velocity.x), 1e-6);
  EXPECT_NEAR(fly(on_floor(0.35, {}, g)).back().bodies[0].velocity.x, 0.5 * (g.x + 0.35 * g.z), 1e-3);
}

TEST(Bullet, PutsFrictionIntoTheForceOnABody) {
  const Prepared p = on_floor(0.3, {2, 0, 0}, {0, 0, -9.81});
  const BodyState block = fly(p)[2].bodies[0];
  const double weight = p.job.bodies[0].properties.mass * 9.81;
  EXPECT_NEAR(block.force.z, weight, 1e-6 * weight);
  EXPECT_NEAR(block.force.x, -0.3 * weight, 1e-3 * weight);
}

TEST(Bullet, SaysWhatLawsOfContactItHolds) {
  Prepared p = on_floor(0.3, {}, {0, 0, -9.81});
  p.job.settings["restitution"] = 0.6;
  BulletEngine engine;
  engine.load(p.job, p.initial);
  EXPECT_NEAR(engine.readback().bodies.at(0).friction, 0.3, 1e-15);
  EXPECT_NEAR(engine.readback().bodies.at(0).restitution, 0.6, 1e-15);
}

TEST(Bullet, RepeatsItsBits) {
  const Prepared p = head_on(0.5, 1e-3);
  EXPECT_EQ(state_hash(fly(p).back()), state_hash(fly(p).back()));
}

TEST(Bullet, HoldsWhatItWasGiven) {
  const Prepared p = test::block({{}, {1, 2, 3}}, {0, 0, -9.81}, 1.0, 2, 0.01);
  BulletEngine engine;
  engine.load(p.job, p.initial);
  const Readback held = engine.readback();
  EXPECT_EQ(held.gravity, (Vec3{0, 0, -9.81}));
  EXPECT_NEAR(held.time_step, 0.01, 1e-15);
  EXPECT_NEAR(held.bodies.at(0).mass, 1.0, 1e-12);
  EXPECT_LT(norm(held.bodies[0].principal_inertia - p.job.bodies[0].properties.principal_inertia), 1e-15);
  EXPECT_EQ(held.bodies[0].linear_damping, 0.0);
}

TEST(Bullet, HasTheLibrarysNumbersUnlessAPresetSaysOtherwise) {
  const btContactSolverInfo library;
  const bullet::Preset ours;
  constexpr double single = 1e-7;  // the library writes some of them in single precision
  EXPECT_EQ(ours.iterations, library.m_numIterations);
  EXPECT_NEAR(ours.erp2, library.m_erp2, single);
  EXPECT_NEAR(ours.split_threshold, library.m_splitImpulsePenetrationThreshold, single);
  EXPECT_NEAR(ours.restitution_threshold, library.m_restitutionVelocityThreshold, single);
  EXPECT_NEAR(ours.restitution, library.m_restitution, single);
}

TEST(Bullet, TakesTheIterationsOfTheJobBeforeThoseOfItsPreset) {
  Job job;
  job.preset = "resting";
  EXPECT_EQ(bullet::preset_for(job).iterations, 200);
  job.resolution.iterations = 30;
  EXPECT_EQ(bullet::preset_for(job).iterations, 30);
}

TEST(Bullet, SaysWhyItRefuses) {
  const Prepared good = test::block({}, {}, 1.0, 1, 0.01);
  const BulletEngine engine;
  const auto reason = [&](auto change) {
    Job job = good.job;
    change(job);
    return engine.refusal(job);
  };
  EXPECT_NE(reason([](Job& j) { j.bodies[0].phase = Phase::liquid; }).find("rigid bodies only"),
            std::string::npos);
  EXPECT_NE(reason([](Job& j) { j.scene.bodies[0].temperature = TemperatureField{}; }).find("heat"),
            std::string::npos);
  EXPECT_NE(reason([](Job& j) { j.scene.mode = Mode::paper; }).find("paper"), std::string::npos);
  EXPECT_NE(reason([](Job& j) { j.scene.periodic[1] = true; }).find("periodic"), std::string::npos);
  EXPECT_NE(reason([](Job& j) { j.preset = "soft"; }).find("no preset 'soft'"), std::string::npos);
  EXPECT_NE(reason([](Job& j) { j.settings["gyro"] = std::string("maybe"); }).find("gyro"),
            std::string::npos);
  for (const char* key : {"rolling_friction", "spinning_friction"})
    EXPECT_NE(reason([&](Job& j) { j.settings[key] = 0.5; }).find("no setting"), std::string::npos) << key;
  EXPECT_NE(reason([](Job& j) { j.settings["friction"] = -0.5; }).find("0 or more"), std::string::npos);
  EXPECT_NE(reason([](Job& j) {
              j.bodies[0].angular_velocity = {0, 0, 100};
            }).find("pi/4"),
            std::string::npos);
}

}  // namespace
}  // namespace tripoint
