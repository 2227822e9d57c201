// SPDX-License-Identifier: BSD-3-Clause
// Only what is called for: what can never act is left out, and nothing else changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "assembly/plan.hpp"
#include "effects/fluid_lab.hpp"
#include "effects/fracture/unbroken_proof.hpp"
#include "scene/temperatures.hpp"

namespace tripoint {
namespace {

std::string why_without(const Plan& p, std::string_view effect) {
  const auto at = std::ranges::find(p.idle, effect, &PlannedEffect::name);
  return at == p.idle.end() ? "" : at->why;
}

/// A splash on a floor: all at 300 K, in a material that conducts and could freeze at 250 K.
lab::Lab splash(Mode mode) {
  lab::Lab lab = lab::liquid_lab(0.05, 1000.0, 0.1, 100.0, mode);
  Material& m = lab.scene.materials[0];
  m.t_melt = 260.0;
  m.t_solid = 250.0;
  m.latent_heat = 3e5;
  lab.scene.gravity = {0.0, 0.0, -9.81};
  const auto warm = [](const Vec3&) { return 300.0; };
  lab.add_material(2500.0, 1.0, 800.0);
  lab.scene.materials[1].stiffness = 100.0;
  lab.add({.name = "water",
           .corner = {0.0, 0.0, 0.05},
           .count = {5, 5, 6},
           .phase = Phase::liquid,
           .velocity = {0.1, 0.0, -0.5},
           .temperature = warm});
  lab.add({.name = "floor",
           .material = 1,
           .corner = {-0.1, -0.1, -0.1},
           .count = {9, 9, 3},
           .motion = Motion::fixed,
           .temperature = warm});
  for (Body& b : lab.scene.bodies) b.temperature->value = 300.0;
  lab.scene.time_step = 1e-3;
  return lab;
}

/// The same scene with an event that could matter and comes after all steps: what it would do decides what is
/// computed.
lab::Lab with_event(lab::Lab lab, double time, double temperature) {
  Event e;
  e.kind = Event::Kind::heat;
  e.name = "heater";
  e.time = time;
  e.temperature = temperature;
  e.bodies = {"floor"};
  lab.scene.events.push_back(e);
  return lab;
}

void expect_same_motion(const Simulation& a, const Simulation& b) {
  for (const auto* f : {&field::position.x, &field::position.y, &field::position.z, &field::velocity.x,
                        &field::velocity.y, &field::velocity.z, &field::density, &field::pressure})
    EXPECT_EQ(lab::by_id(a, *f), lab::by_id(b, *f)) << f->name;
}

TEST(OnlyWhatIsCalledFor, EqualTemperaturesCostNoColumnAndNoPairTermAndChangeNothing) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const lab::Lab equal = splash(mode), armed = with_event(equal, 100.0, 400.0);
    lab::Lab cold = equal;  // the same without heat at all
    for (Body& b : cold.scene.bodies) b.temperature.reset();
    EXPECT_EQ(plan(equal.scene).bytes_per_particle, plan(cold.scene).bytes_per_particle);
    EXPECT_GT(plan(armed.scene).bytes_per_particle, plan(equal.scene).bytes_per_particle);
    Simulation without = equal.run(0.05), with = armed.run(0.05);
    EXPECT_FALSE(without.state().particles.has(field::temperature));
    for (const double T : lab::by_id(with, field::temperature))
      EXPECT_NEAR(T, 300.0, 300.0 * 4e-15) << "one rounding of H = m c_p T and back, and of each step";
    expect_same_motion(without, with);
    const double thermal = with.ledger().energy.at("thermal");
    EXPECT_NEAR(without.ledger().energy.at("thermal"), thermal, 1e-12 * thermal);
  }
}

TEST(OnlyWhatIsCalledFor, ATemperatureThatAnEventBringsArmsHeatFromTheStart) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    Simulation s = with_event(splash(mode), 0.01, 320.0).run(0.05);
    const auto T = lab::by_id(s, field::temperature);
    EXPECT_EQ(T.back(), 320.0) << "the floor is held";
    EXPECT_GT(T.front(), 300.0 - 1e-9);
    EXPECT_GT(s.ledger().energy.at("thermal"), splash(mode).run(0.05).ledger().energy.at("thermal"));
  }
}

TEST(OnlyWhatIsCalledFor, OneOtherTemperatureOfBodyInflowOrEventMakesThemUnequal) {
  lab::Lab lab = splash(Mode::corrected);
  EXPECT_EQ(equal_temperature(lab.scene), 300.0);
  EXPECT_EQ(equal_temperature(with_event(lab, 1.0, 300.0).scene), 300.0);
  EXPECT_EQ(equal_temperature(with_event(lab, 1.0, 301.0).scene), std::nullopt);
  lab::Lab inflow = lab;
  Inflow& poured = inflow.scene.inflows.emplace_back();
  poured.material = lab.scene.materials[0].name;
  poured.temperature = 299.0;
  EXPECT_EQ(equal_temperature(inflow.scene), std::nullopt);
  poured.temperature = 300.0;
  EXPECT_EQ(equal_temperature(inflow.scene), 300.0);
  lab.scene.bodies[1].temperature->kind = TemperatureField::Kind::expression;
  EXPECT_EQ(equal_temperature(lab.scene), std::nullopt) << "anything may come of an expression";
  lab.scene.bodies[1].temperature.reset();
  EXPECT_EQ(equal_temperature(lab.scene), std::nullopt)
      << "a body without a temperature is an error that heat must tell";
}

TEST(OnlyWhatIsCalledFor, WhatStaysWarmerThanItFreezesHasNoPhaseCheckAndWhatIsCooledLaterHas) {
  const lab::Lab warm = with_event(splash(Mode::corrected), 100.0, 251.0),
                 cooled = with_event(splash(Mode::corrected), 100.0, 240.0);
  EXPECT_FALSE(lab::lists(plan(warm.scene), "liquid_fraction"));
  EXPECT_NE(why_without(plan(warm.scene), "phase").find("251 to 300 K"), std::string::npos)
      << why_without(plan(warm.scene), "phase");
  EXPECT_TRUE(lab::lists(plan(cooled.scene), "liquid_fraction"));
  EXPECT_EQ(why_without(plan(cooled.scene), "phase"), "");
}

TEST(OnlyWhatIsCalledFor, EveryEffectIsEitherOnOrLeftOutForAReason) {
  const Plan p = plan(splash(Mode::corrected).scene);
  for (const char* name :
       {"pressure", "viscosity", "elastic", "plastic", "fracture", "rigid", "heat", "phase"}) {
    const bool on = std::ranges::find(p.effects, name, &PlannedEffect::name) != p.effects.end();
    EXPECT_NE(on, !why_without(p, name).empty()) << name;
  }
}

/// Particles of a chain that shake more and more, looked at again only where `UnbrokenProof` asks for it.
TEST(UnbrokenProof, NeverHoldsWhereABondIsBeyondItsLimitAndMostlyHoldsWhereNoneIs) {
  State state;
  state.scene.spacing = 1.0;
  constexpr std::size_t n = 50;
  state.particles = Particles(n, common_fields(false));
  const auto x = positions(state.particles);
  for (std::size_t i = 0; i < n; ++i) x.set(i, {double(i), 0.0, 0.0});
  constexpr double limit = 1.5;
  const auto least_headroom = [&] {
    double headroom = 1e300;
    for (std::size_t i = 0; i + 1 < n; ++i)
      headroom = std::min(headroom, limit - norm(x.at(i + 1) - x.at(i)));
    return headroom;
  };
  std::mt19937_64 random(1);
  std::normal_distribution<double> kick(0.0, 0.004);
  fracture::UnbrokenProof unbroken;
  EXPECT_FALSE(unbroken.holds(state));
  int held = 0, looked = 0, steps = 0;
  for (; least_headroom() > 0.0 && steps < 100'000; ++steps) {
    if (unbroken.holds(state))
      ++held;
    else {
      ++looked;
      unbroken.set(state, least_headroom());
    }
    for (std::size_t i = 0; i < n; ++i)
      x.set(i, x.at(i) + Vec3{0.3, 0.0, 0.0} + Vec3{kick(random), kick(random), kick(random)});
  }
  EXPECT_LT(steps, 100'000) << "a bond must have broken";
  EXPECT_FALSE(unbroken.holds(state));
  EXPECT_GT(held, looked) << "that all fly together is no reason to look";
  unbroken.clear();
  EXPECT_FALSE(unbroken.holds(state));
}

}  // namespace
}  // namespace tripoint
