// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effects/phase_lab.hpp"
#include "effects/plastic/flow.hpp"
#include "scene/effect_rule.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.1, hot = 400.0, cold = 300.0;

Event heat(double time, double temperature, double beyond) {
  Event e;
  e.kind = Event::Kind::heat;
  e.time = time;
  e.temperature = temperature;
  e.region.emplace();
  e.region->kind = Shape::Kind::box;
  e.region->min = {beyond, -10.0, -10.0};
  e.region->max = {10.0, 10.0, 10.0};
  return e;
}

/// A bar of 8 x 3 x 3 that swings along itself beyond its elastic limit.
lab::Lab yielding_bar() {
  lab::Lab lab = lab::melting_lab(dx, {.latent_heat = 2e4, .solid = SolidKind::elastic});
  lab.scene.materials[0].stiffness = 1e-12;
  lab.scene.materials[0].elastic_limit = 0.01;
  lab.scene.time_step = 5e-4;
  lab.add({.name = "bar", .count = {8, 3, 3}, .phase = Phase::elastic, .temperature = [](const Vec3&) {
             return cold;
           }});
  lab.scene.bodies[0].temperature->value = hot;
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    lab.initial.velocity[i] = {4.0 * (lab.initial.position[i].x - 0.35), 0.0, 0.0};
  return lab;
}

TEST(PlasticMelting, ClosesTheEnergyAndForgetsTheFlowOfWhatMelts) {
  lab::Lab lab = yielding_bar();
  lab.scene.events = {heat(0.03, hot, 0.35), heat(0.032, 250.0, 0.35)};
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.0299);
  const Ledger strained = s.ledger();
  EXPECT_GT(strained.energy.at("plastic"), 0.05 * strained.energy.at("kinetic"));
  s.advance_to(0.0305);
  const State& w = s.state();
  std::size_t molten = 0, flowed = 0;
  for (std::size_t i = 0; i < w.particles.size(); ++i) {
    const bool liquid = w.particles[field::phase][i] == 0;
    molten += liquid ? 1 : 0;
    if (liquid) {
      EXPECT_EQ(solid::plastic_strain_of(w.particles, i), Symmetric{});
    } else {
      flowed += solid::plastic_strain_of(w.particles, i) == Symmetric{} ? 0 : 1;
    }
  }
  EXPECT_EQ(molten, 36u);
  EXPECT_GT(flowed, 18u);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(strained), 1.0, 1e-12);
  s.advance_to(0.04);
  for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 1);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(strained), 1.0, 1e-12);
  EXPECT_LT(std::abs(s.ledger().energy.at("time_integration")), 0.02 * strained.energy.at("kinetic"));
}

/// Strains about the limit, to the last digits, with and without a pressure.
TEST(PlasticFlow, LooksWhereverMatterFlowsAndNotBelowTheLimit) {
  const lab::Lab lab = yielding_bar();
  const Simulation s(lab.scene, lab.initial);
  const solid::ElasticForms forms(s.state().scene);
  const auto constants = forms.constants(s.state());
  const plastic::YieldLimits limits{.elastic = 0.01};
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 0; n < 4000; ++n) {
    const Symmetric shear = deviator({u(engine), u(engine), u(engine), u(engine), u(engine), u(engine)});
    const double beyond = std::pow(10.0, -1.0 - n % 16), pressure = n % 3 == 0 ? 0.0 : u(engine);
    const Symmetric volume{pressure, pressure, pressure, 0.0, 0.0, 0.0};
    const auto strain = [&](double size) {
      return (size * limits.elastic / plastic::size(shear)) * shear + volume;
    };
    const Symmetric above = strain(1.0 + beyond), below = strain(1.0 - std::max(beyond, 1e-9));
    EXPECT_TRUE(constants.may_flow(0, 3, above) || plastic::flowed(above, {}, limits) == Symmetric{})
        << beyond;
    EXPECT_FALSE(constants.may_flow(0, 3, below)) << beyond;
  }
  EXPECT_TRUE(constants.may_flow(0, 2, {}));
  EXPECT_FALSE(constants.may_flow(0, 0, {}));
}

TEST(PlasticFreezing, CallsForPlasticFlowAndFractureWhereWhatFreezesCanYieldAndBreak) {
  lab::Lab lab = lab::melting_lab(dx, {.solid = SolidKind::elastic});
  lab.add({.name = "pool", .count = {3, 3, 3}, .phase = Phase::liquid, .temperature = [](const Vec3&) {
             return 300.0;
           }});
  lab.scene.bodies[0].temperature->value = 300.0;
  const auto calls = [&](std::string_view name) {
    return std::ranges::any_of(called_effects(lab.scene),
                               [&](const CalledEffect& e) { return e.name == name; });
  };
  EXPECT_TRUE(calls("elastic"));
  EXPECT_FALSE(calls("plastic"));
  EXPECT_FALSE(calls("fracture"));
  lab.scene.materials[0].elastic_limit = 0.01;
  lab.scene.materials[0].fracture_stretch = 1.2;
  EXPECT_TRUE(calls("plastic"));
  EXPECT_TRUE(calls("fracture"));
}

}  // namespace
}  // namespace tripoint
