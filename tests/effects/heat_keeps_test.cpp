// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "effects/lab.hpp"

namespace tripoint {
namespace {

/// Two blocks in contact, densities 5 : 1, conductivities 10 : 1, at 400 and 300 K.
lab::Lab two_blocks(Mode mode, std::optional<double> held = {}) {
  const double dx = 1e-3;
  lab::Lab lab(dx, mode);
  lab.add_material(200.0, 10.0, 1000.0);
  lab.add({.name = "a", .count = {6, 5, 5}, .motion = Motion::fixed, .temperature = [](const Vec3&) {
             return 300.0;
           }});
  lab.add({.name = "b",
           .material = 1,
           .corner = {6 * dx, 0.0, 0.0},
           .count = {6, 5, 5},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 400.0; },
           .temperature_held = held.has_value()});
  return lab;
}

TEST(CorrectedHeat, KeepsTheHeatContentAcrossADensityJump) {
  const lab::Lab lab = two_blocks(Mode::corrected);
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(2.0);
  EXPECT_GT(s.steps(), 100);
  EXPECT_GT(lab::by_id(s, field::temperature)[5], 301.0);  // heat has crossed the face
  // round-off of antisymmetric sums over all steps
  EXPECT_NEAR(s.ledger().energy.at("thermal") / before, 1.0, 1e-12);
}

TEST(PaperHeat, LosesHeatAcrossADensityJumpAsItIsPrinted) {
  const lab::Lab lab = two_blocks(Mode::paper);
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(2.0);
  // a defect of the printed form, not of round-off
  EXPECT_GT(std::abs(s.ledger().energy.at("thermal") / before - 1.0), 1e-3);
}

TEST(CorrectedHeat, AccumulatesWhatHeldTemperaturesGive) {
  const lab::Lab lab = two_blocks(Mode::corrected, 400.0);
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(0.5);
  const Ledger after = s.ledger();
  EXPECT_GT(after.energy.at("thermal") - before, 1e-3 * before);
  EXPECT_NEAR((after.energy.at("thermal") + after.energy.at("walls")) / before, 1.0, 1e-12);
  const auto T = lab::by_id(s, field::temperature);
  for (std::size_t id = 150; id < T.size(); ++id) EXPECT_EQ(T[id], 400.0);
}

TEST(CorrectedHeat, EventHoldsATemperatureAndLetsItGo) {
  lab::Lab lab = two_blocks(Mode::corrected);
  Event heat;
  heat.kind = Event::Kind::heat;
  heat.time = 0.1;
  heat.until = 0.2;
  heat.bodies = {"a"};
  heat.temperature = 500.0;
  lab.scene.events.push_back(heat);
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(0.15);
  EXPECT_EQ(lab::by_id(s, field::temperature)[0], 500.0);
  s.advance_to(0.3);
  EXPECT_LT(lab::by_id(s, field::temperature)[5], 500.0);
  const Ledger after = s.ledger();
  EXPECT_NEAR((after.energy.at("thermal") + after.energy.at("walls")) / before, 1.0, 1e-12);
}

TEST(CorrectedHeat, LeavesASteadyBarOfTwoConductivitiesAlone) {
  // Conductivities 10 : 1 in series between held ends: the exact profile is two straight lines that meet at
  // T_face.
  const double dx = 1e-3, half = 10 * dx, T_face = 300.0 + 100.0 * 1.0 / 11.0, end = 3 * dx;
  lab::Lab lab(dx);
  lab.make_periodic({false, true, true}, {0.0, 0.0, 0.0}, {1, 3, 3});
  lab.add_material(1000.0, 10.0, 1000.0);
  const auto exact = [&](const Vec3& r) {
    const double x = r.x + 0.5 * dx - half;  // from the face between the materials
    return x < 0.0 ? T_face + x * (T_face - 300.0) / half : T_face + x * (400.0 - T_face) / half;
  };
  const auto part = [&](std::string name, std::size_t material, double from, int count, bool held) {
    lab.add({.name = std::move(name),
             .material = material,
             .corner = {from, 0.0, 0.0},
             .count = {count, 3, 3},
             .motion = Motion::fixed,
             .temperature = exact,
             .temperature_held = held});
  };
  part("cold end", 1, -end, 3, true);
  part("good conductor", 1, 0.0, 10, false);
  part("poor conductor", 0, half, 10, false);
  part("hot end", 0, 2.0 * half, 3, true);
  const Simulation s = lab.run(60.0, 1);
  const auto T = lab::by_id(s, field::temperature);
  double worst = 0.0;
  for (std::size_t id = 0; id < T.size(); ++id)
    worst = std::max(worst, std::abs(T[id] - exact(lab.initial.position[id])) / 100.0);
  // 0.6e-3 to 1.8e-3 with the harmonic mean, 2e-2 to 6e-2 with the arithmetic one (model 8.6)
  EXPECT_LT(worst, 2e-3);
}

/// Random temperatures on a jittered block: the hardest start there is.
lab::Lab noise(Mode mode) {
  lab::Lab lab(1e-3, mode);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  lab.add({.count = {7, 7, 7}, .motion = Motion::fixed, .temperature = [&](const Vec3&) {
             return 300.0 + 100.0 * uniform(random);
           }});
  for (Vec3& r : lab.initial.position)
    r += 2e-4 * Vec3{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5};
  return lab;
}

TEST(Heat, MakesNoNewExtremesAtItsOwnTimeStep) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const lab::Lab lab = noise(mode);
    Simulation s(lab.scene, lab.initial);
    auto [low, high] = std::ranges::minmax(lab::by_id(s, field::temperature));
    for (int n = 1; n <= 20; ++n) {
      s.advance_to(n * s.bound().dt);
      const auto [lower, higher] = std::ranges::minmax(lab::by_id(s, field::temperature));
      EXPECT_GE(lower, low * (1.0 - 1e-15));
      EXPECT_LE(higher, high * (1.0 + 1e-15));
      low = lower;
      high = higher;
    }
  }
}

TEST(Heat, RefusesATimeStepAboveItsBoundByName) {
  lab::Lab lab = noise(Mode::corrected);
  lab.scene.time_step = 10.0;
  try {
    const Simulation s(lab.scene, lab.initial);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("bound of heat"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tripoint
