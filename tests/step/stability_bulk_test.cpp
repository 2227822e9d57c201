// SPDX-License-Identifier: BSD-3-Clause
// The numerical bulk viscosity acts on velocities of half a step before: it narrows what is stable, and must
// leave the step to sound (model 8.10).
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "effects/fluid_lab.hpp"
#include "scene/shared_terms.hpp"
#include "step/stability_lab.hpp"

namespace tripoint::stability {
namespace {

using lab::Lab;

enum class Place { layers, mixed };

/// A periodic sea, pressed by 0.6 %, of a light liquid and one `ratio` times as dense, in two layers or
/// particle by particle at random.
Lab pressed_sea(double ratio, Place place) {
  Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  const std::size_t heavy = lab::add_material_like(lab, ratio, 0.0);
  lab.add({.name = "light", .count = {side, side, side}, .phase = Phase::liquid});
  lab.add({.name = "heavy",
           .material = heavy,
           .corner = {0.0, 0.0, double(side)},
           .count = {side, side, side},
           .phase = Phase::liquid});
  if (place == Place::mixed) {
    InitialState& s = lab.initial;
    std::mt19937_64 random(4);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const int is_heavy = static_cast<int>(random() % 2);
      s.material[i] = s.source[i] = is_heavy;
      s.mass[i] = is_heavy ? ratio : 1.0;
    }
  }
  const double squeeze = 0.998;
  for (Vec3& r : lab.initial.position) r = squeeze * r;
  lab.make_periodic({true, true, true}, {}, {side, side, 2 * side});
  lab.scene.max = *lab.scene.min + squeeze * (*lab.scene.max - *lab.scene.min);
  disturb(lab, 1e-7 * std::sqrt(ratio));
  return lab;
}

/// Longest stable step [s], to half a per cent, looked for up to four times the solver's own.
double frontier(const Lab& lab) {
  const auto stable = stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, lab.initial)));
  double low = 0.1 * own_step(lab), high = 40.0 * low;
  if (!stable(low)) return 0.0;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

TEST(BulkViscosity, HasTheFrontierOfAWaveThatItDampsByFrequencySquared) {
  const Lab lab = pressed_sea(1.0, Place::layers);
  Lab elastic = lab;
  elastic.scene.modes[term::clamp] = Mode::paper;
  // Zeta h/c, c = 1
  const double w = 2.0 / oscillation_limit(elastic, false), damped = w * w * 0.2 * lab.scene.support_ratio;
  EXPECT_NEAR(frontier(lab) * (w * w) / (std::sqrt(damped * damped + 4.0 * w * w) - damped), 1.0, 0.05);
}

/// Without the limit on heavy liquids no step of that size is stable at 1:1000, nor one of a twentieth.
TEST(BulkViscosity, IsStableAtTheStepOfSoundWhateverLiquidsMix) {
  for (const Place place : {Place::layers, Place::mixed}) {
    for (const double ratio : {1.0, 2.0, 4.0, 10.0, 1000.0}) {
      const Lab lab = pressed_sea(ratio, place);
      EXPECT_EQ(Simulation(lab.scene, lab.initial).bound().name, "sound");
      EXPECT_LT(own_step(lab) / frontier(lab), 0.82)
          << (place == Place::mixed ? "mixed" : "layers") << ", ratio " << ratio;
    }
  }
}

void ask_for(Lab& lab, double zeta) { lab.scene.values["bulk_viscosity"] = zeta; }

/// Above its default the viscosity has the bound, not sound.
TEST(BulkViscosity, IsStableAtItsOwnStepWhateverTheSceneAsks) {
  for (const double zeta : {0.0, 0.2, 0.3, 1.0, 5.0}) {
    for (const double ratio : {1.0, 10.0}) {
      Lab lab = pressed_sea(ratio, Place::mixed);
      ask_for(lab, zeta);
      EXPECT_EQ(Simulation(lab.scene, lab.initial).bound().name, zeta > 0.2 ? "bulk viscosity" : "sound")
          << zeta;
      EXPECT_LT(own_step(lab) / frontier(lab), 0.82) << "zeta " << zeta << ", ratio " << ratio;
    }
  }
}

/// What it takes of a pressed sea in some steps, over the kinetic energy there; nothing where the ledger has
/// no such entry.
std::optional<double> taken(std::optional<double> zeta) {
  Lab lab = pressed_sea(1.0, Place::layers);
  if (zeta) ask_for(lab, *zeta);
  disturb(lab, 1e-3);
  Simulation s(lab.scene, lab.initial);
  const double before = kinetic(s);
  s.advance_to(20.0 * own_step(lab));
  const auto ledger = s.ledger();
  const auto entry = ledger.energy.find("bulk_viscous");
  if (entry == ledger.energy.end()) return {};
  return entry->second / before;
}

TEST(BulkViscosity, TakesWhatTheSceneAsksAndIsNotThereAtZero) {
  EXPECT_EQ(taken(0.0), std::nullopt);
  EXPECT_EQ(taken(std::nullopt), taken(0.2));  // a scene that no reader made has the key's fallback
  const double some = taken(0.05).value(), twice = taken(0.1).value();
  EXPECT_GT(some, 1e-3);
  EXPECT_GT(twice, 1.2 * some);
  EXPECT_LT(twice, 2.0 * some);
}

}  // namespace
}  // namespace tripoint::stability
