// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/heat/fields.hpp"
#include "effects/phase_lab.hpp"
#include "scene/shared_terms.hpp"
#include "solids/fusion.hpp"

namespace tripoint {
namespace {

const Fusion wax{.melts = 350.0, .solidifies = 340.0, .heat = 20.0};

/// c_p T + L f over c_p [K]
double content(const ThermalState& s) { return s.temperature + wax.heat * s.liquid_fraction; }

TEST(Fusion, KeepsTheHeatAndStopsTheTemperatureWhileItMelts) {
  const ThermalState half = settled(wax, 360.0, 0.0);
  EXPECT_DOUBLE_EQ(half.temperature, 350.0);
  EXPECT_DOUBLE_EQ(half.liquid_fraction, 0.5);
  const ThermalState whole = settled(wax, 375.0, 0.0);
  EXPECT_DOUBLE_EQ(whole.temperature, 355.0);
  EXPECT_DOUBLE_EQ(whole.liquid_fraction, 1.0);
  EXPECT_DOUBLE_EQ(content(whole), 375.0);
}

TEST(Fusion, KeepsItsFractionBetweenTheTwoTemperatures) {
  for (const double f : {0.0, 0.3, 1.0}) {
    for (const double T : {340.0, 345.0, 350.0}) {
      EXPECT_EQ(settled(wax, T, f).liquid_fraction, f);
      EXPECT_EQ(settled(wax, T, f).temperature, T);
    }
  }
}

TEST(Fusion, GoesRoundAClosedLoop) {
  ThermalState s{330.0, 0.0};
  const double start = content(s);
  double given = 0.0, lower = 0.0, upper = 0.0;
  const auto heat = [&](double kelvin) {
    given += kelvin;
    s = settled(wax, s.temperature + kelvin, s.liquid_fraction);
  };
  for (int n = 0; n < 500; ++n) {
    heat(0.1);
    if (s.liquid_fraction > 0.49 && s.liquid_fraction < 0.51) upper = s.temperature;
  }
  EXPECT_EQ(s.liquid_fraction, 1.0);
  for (int n = 0; n < 500; ++n) {
    heat(-0.1);
    if (s.liquid_fraction > 0.49 && s.liquid_fraction < 0.51) lower = s.temperature;
  }
  EXPECT_EQ(s.liquid_fraction, 0.0);
  EXPECT_NEAR(upper, 350.0, 1e-9);
  EXPECT_NEAR(lower, 340.0, 1e-9);
  EXPECT_NEAR(content(s), start + given, 1e-9);  // round-off of a thousand sums of 400 K
  EXPECT_NEAR(s.temperature, 330.0, 1e-9);
}

TEST(Fusion, WithoutLatentHeatJumps) {
  const Fusion at_once{.melts = 350.0, .solidifies = 350.0, .heat = 0.0};
  EXPECT_EQ(settled(at_once, 350.1, 0.0).liquid_fraction, 1.0);
  EXPECT_EQ(settled(at_once, 350.0, 0.0).liquid_fraction, 0.0);
  EXPECT_EQ(settled(at_once, 349.9, 1.0).liquid_fraction, 0.0);
  EXPECT_EQ(settled(at_once, 360.0, 0.0).temperature, 360.0);
}

TEST(Fusion, OfAMaterialThatDoesNotMeltIsNone) {
  const lab::Lab lab(0.1);
  const Fusion none = fusion_of(lab.scene, lab.scene.materials[0]);
  EXPECT_EQ(settled(none, 1e4, 0.0).liquid_fraction, 0.0);
  EXPECT_EQ(settled(none, 1.0, 1.0).liquid_fraction, 1.0);
}

/// Ice and water: the liquid holds twice the heat, L/c of the ice = 160 K; freezes 4 K lower.
const Fusion icy{.melts = 273.0, .solidifies = 269.0, .heat = 160.0, .jump = 1.0};

/// H/(m c), c of the ice: c_s T of the ice, c_s t_melt + L + c_l (T - t_melt) of the water, by shares [K].
double icy_content(const ThermalState& s) {
  const double f = s.liquid_fraction;
  return (1.0 - f) * s.temperature + f * (273.0 + 160.0 + 2.0 * (s.temperature - 273.0));
}

TEST(Fusion, CountsTheHeatOfEachPhaseByItsOwnCapacity) {
  for (const double f : {0.0, 0.3, 1.0})
    for (const double T : {250.0, 273.0, 300.0}) {
      const double content = T + bound_heat(icy, T, f);
      EXPECT_NEAR(content, icy_content({T, f}), 1e-10);
      EXPECT_NEAR(temperature_at(icy, content, f), T, 1e-10);
    }
  // from ice at 263 K: 10 K to t_melt, 160 K of fusion, and 30 K of ice's heat warm water by 15 K
  const ThermalState water = settled(icy, 263.0 + 10.0 + 160.0 + 30.0, 0.0);
  EXPECT_NEAR(water.temperature, 288.0, 1e-10);
  EXPECT_EQ(water.liquid_fraction, 1.0);
  // water supercooled to 269 K has 160 - 4 K to release: a quarter of it freezes a quarter
  const ThermalState quarter = settled(icy, 269.0 - 0.25 * 156.0 / 2.0, 1.0);
  EXPECT_NEAR(quarter.temperature, 269.0, 1e-10);
  EXPECT_NEAR(quarter.liquid_fraction, 0.75, 1e-12);
}

TEST(Fusion, OfUnlikePhasesGoesRoundAClosedLoop) {
  ThermalState s{253.0, 0.0};
  const auto heat = [&](double kelvin) {
    const double content = icy_content(s) + kelvin;
    s = settled(icy, temperature_at(icy, content, s.liquid_fraction), s.liquid_fraction);
    EXPECT_NEAR(icy_content(s), content, 1e-10);
  };
  for (int n = 0; n < 260; ++n) heat(1.0);  // 20 + 160 + 2 x 40
  EXPECT_EQ(s.liquid_fraction, 1.0);
  EXPECT_NEAR(s.temperature, 313.0, 1e-9);
  for (int n = 0; n < 260; ++n) heat(-1.0);
  EXPECT_EQ(s.liquid_fraction, 0.0);
  EXPECT_NEAR(s.temperature, 253.0, 1e-9);
}

/// A fixed bar that melts from a hot block on its left; 12 x 3 x 3 particles, periodic across.
lab::Lab melting_bar(Mode mode = Mode::corrected) {
  lab::Lab lab =
      lab::melting_lab(0.1, {.t_melt = 350.0, .t_solid = 345.0, .latent_heat = 2e4, .conductivity = 1000.0});
  lab.set_mode(mode);
  lab.scene.support_ratio = 2.6;
  lab.add_material(1000.0, 1000.0, 1000.0);
  lab.add({.name = "bar",
           .corner = {},
           .count = {12, 3, 3},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 348.0; }});
  lab.add({.name = "hot",
           .material = 1,
           .corner = {-0.3, 0.0, 0.0},
           .count = {3, 3, 3},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 380.0; },
           .temperature_held = true});
  lab.scene.bodies[0].temperature->value = 380.0;  // what the scene is asked by
  lab.make_periodic({false, true, true}, {-0.3, 0.0, 0.0}, {15, 3, 3});
  return lab;
}

TEST(Melting, TogglesNothingAndLosesNoHeat) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const lab::Lab lab = melting_bar(mode);
    Simulation s(lab.scene, lab.initial);
    const Ledger start = s.ledger();
    std::vector<int> changes(lab.initial.size(), 0), before = lab::integers_by_id(s, field::phase);
    for (int n = 1; n <= 60; ++n) {
      s.advance_to(5.0 * n);
      const std::vector<int> now = lab::integers_by_id(s, field::phase);
      for (std::size_t i = 0; i < now.size(); ++i) changes[i] += now[i] != before[i] ? 1 : 0;
      before = now;
    }
    const Ledger end = s.ledger();
    const double melted = static_cast<double>(std::count(before.begin(), before.end(), 0));
    EXPECT_GT(melted, 30.0);
    EXPECT_EQ(std::ranges::max(changes), 1);
    if (mode == Mode::corrected) {
      // round-off of some thousand sums over 135 particles
      EXPECT_NEAR(lab::total_energy(end) / lab::total_energy(start), 1.0, 1e-12);
      const auto f = lab::by_id(s, field::liquid_fraction);
      double sum = 0.0;
      for (const double value : f) sum += value;
      EXPECT_NEAR(end.energy.at("latent"), 2e4 * 1.0 * sum, 1e-9 * end.energy.at("latent"));  // 1 kg each
    }
  }
}

TEST(Melting, OfUnlikePhasesConductsByThePhaseAndLosesNoHeat) {
  lab::Lab lab = melting_bar();
  lab.scene.materials[0].solid_conductivity = 3000.0;
  lab.scene.materials[0].solid_heat_capacity = 500.0;
  Simulation s(lab.scene, lab.initial);
  const double start = lab::total_energy(s.ledger());
  for (int n = 1; n <= 20; ++n) s.advance_to(5.0 * n);
  const auto f = lab::by_id(s, field::liquid_fraction), k = lab::by_id(s, field::conductivity),
             T = lab::by_id(s, field::temperature), H = lab::by_id(s, field::enthalpy);
  double between = 0.0, melted = 0.0;
  for (std::size_t i = 0; i < 108; ++i) {           // the bar, 1 kg a particle
    EXPECT_EQ(k[i], f[i] > 0.0 ? 1000.0 : 3000.0);  // what melts conducts as the liquid that it becomes
    EXPECT_NEAR(H[i], (1.0 - f[i]) * 500.0 * T[i] + f[i] * (500.0 * 350.0 + 2e4 + 1000.0 * (T[i] - 350.0)),
                1e-9 * H[i]);
    between += f[i] > 0.0 && f[i] < 1.0 ? 1.0 : 0.0;
    melted += f[i];
  }
  EXPECT_GT(between, 0.0);
  EXPECT_GT(melted, 18.0);
  EXPECT_LT(melted, 100.0);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / start, 1.0, 1e-12);
  EXPECT_NEAR(s.ledger().energy.at("latent"), 2e4 * melted, 1e-9 * 2e4 * melted);
}

TEST(Melting, OfUnlikePhasesIsRefusedAsPrinted) {
  for (const Term& one : {term::heat, term::phase}) {
    lab::Lab lab = melting_bar();
    lab.scene.materials[0].solid_conductivity = 3000.0;
    lab.scene.modes[one] = Mode::paper;
    EXPECT_THROW(Simulation(lab.scene, lab.initial), InputError);
  }
}

TEST(Heat, OfWhatHoldsABodyIsCountedBodyByBody) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    lab::Lab lab(0.1, mode);
    lab.make_periodic({false, true, true}, {-0.3, 0.0, 0.0}, {12, 3, 3});
    lab.add({.name = "hot",
             .corner = {-0.3, 0.0, 0.0},
             .count = {3, 3, 3},
             .motion = Motion::fixed,
             .temperature = [](const Vec3&) { return 380.0; },
             .temperature_held = true});
    lab.add({.name = "bar",
             .corner = {},
             .count = {6, 3, 3},
             .motion = Motion::fixed,
             .temperature = [](const Vec3&) { return 340.0; }});
    lab.add({.name = "cold",
             .corner = {0.6, 0.0, 0.0},
             .count = {3, 3, 3},
             .motion = Motion::fixed,
             .temperature = [](const Vec3&) { return 300.0; },
             .temperature_held = true});
    lab.scene.bodies[0].temperature->value = 380.0;
    Simulation s(lab.scene, lab.initial);
    const double start = s.ledger().energy.at("thermal");
    s.advance_to(2e4);
    const auto heat = s.state().bodies[field::body_heat];
    EXPECT_GT(heat[0], 0.0);
    EXPECT_EQ(heat[1], 0.0);
    EXPECT_LT(heat[2], 0.0);
    // Of sums of 2e7 J
    EXPECT_NEAR(heat[0] + heat[2], s.ledger().energy.at("thermal") - start, 1e-6 * heat[0]);
    EXPECT_NEAR(heat[0] + heat[2], -s.ledger().energy.at("walls"), 1e-9 * heat[0]);
  }
}

TEST(Melting, GoesBackOverTheHysteresisAndClosesTheLedger) {
  lab::Lab lab =
      lab::melting_lab(0.1, {.t_melt = 350.0, .t_solid = 340.0, .latent_heat = 2e4, .conductivity = 1000.0});
  lab.scene.end_time = 400.0;
  lab.add({.name = "bar",
           .corner = {},
           .count = {6, 3, 3},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 330.0; }});
  lab.add_material(1000.0, 1000.0, 1000.0);
  lab.add({.name = "plate",
           .material = 1,
           .corner = {-0.3, 0.0, 0.0},
           .count = {3, 3, 3},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 330.0; },
           .temperature_held = true});
  lab.make_periodic({false, true, true}, {-0.3, 0.0, 0.0}, {9, 3, 3});
  for (const auto& [time, T] :
       {std::pair{0.0, 400.0}, std::pair{600.0, 345.0}, std::pair{1200.0, 300.0}, std::pair{1800.0, 345.0}}) {
    Event e;
    e.kind = Event::Kind::heat;
    e.time = time;
    e.bodies = {"plate"};
    e.temperature = T;
    e.until = time + 600.0;
    lab.scene.events.push_back(e);
  }
  Simulation s(lab.scene, lab.initial);
  const double start = lab::total_energy(s.ledger());
  const auto liquid = [&] {
    const auto phase = lab::integers_by_id(s, field::phase);
    return std::count(phase.begin(), phase.begin() + 54, 0);
  };
  s.advance_to(599.0);
  EXPECT_EQ(liquid(), 54);
  s.advance_to(1199.0);  // between the two temperatures: stays liquid
  EXPECT_EQ(liquid(), 54);
  EXPECT_NEAR(lab::by_id(s, field::temperature)[30], 345.0, 1.0);
  s.advance_to(1799.0);
  EXPECT_EQ(liquid(), 0);
  s.advance_to(2399.0);  // and stays solid
  EXPECT_EQ(liquid(), 0);
  EXPECT_NEAR(lab::by_id(s, field::temperature)[30], 345.0, 1.0);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / start, 1.0, 1e-12);
}

}  // namespace
}  // namespace tripoint
