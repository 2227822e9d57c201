// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/fluid_lab.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

double sum_of(const Ledger& ledger) {
  double sum = 0.0;
  for (const auto& [name, value] : ledger.energy) sum += value;
  return sum;
}

/// What became of the energy of a run: all taken at the end, relative to what changed hands.
struct Account {
  double exchanged;         ///< greatest change of the kinetic or potential energy on the way [J]
  double residual;          ///< change of the sum of all entries, over `exchanged`
  double time_integration;  ///< greatest on the way, over `exchanged`
};

Account account(lab::Lab lab, double time, double step) {
  lab.scene.time_step = step;
  Simulation s(lab.scene, lab.initial);
  const Ledger start = s.ledger();
  Account a{};
  double drift = 0.0, scheme = 0.0;
  for (int n = 1; n <= 20; ++n) {
    s.advance_to(time * n / 20);
    const Ledger now = s.ledger();
    for (const char* name : {"kinetic", "potential", "compression"})
      if (now.energy.count(name) > 0) a.exchanged = std::max(a.exchanged, std::abs(now.energy.at(name) - start.energy.at(name)));
    drift = std::max(drift, std::abs(sum_of(now) - sum_of(start)));
    scheme = std::max(scheme, std::abs(now.energy.at("time_integration")));
  }
  a.residual = drift / a.exchanged;
  a.time_integration = scheme / a.exchanged;
  return a;
}

/// A column that was set down at rest density and begins to fall into its own weight.
lab::Lab falling_column() { return lab::column(8, 4, 5.0, 1000.0, 10.0); }

lab::Lab floating_block() {
  lab::Lab lab = lab::column(8, 8, 5.0, 1000.0, 10.0);
  const std::size_t wood = lab::add_material_like(lab, 500.0, 0.0);
  const double dx = lab.scene.spacing;
  lab.add({.name = "block", .material = wood, .corner = {2 * dx, 2 * dx, 8.5 * dx}, .count = {4, 4, 4}});
  return lab;
}

lab::Lab head_on_collision() {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, 400.0);
  lab.scene.materials[0].viscosity = 0.0;
  lab.add({.name = "left", .corner = {-0.55, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {0.5, 0.0, 0.0}});
  lab.add({.name = "right", .corner = {0.25, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {-0.5, 0.0, 0.0}});
  return lab;
}

struct Scene_ {
  const char* name;
  lab::Lab (*make)();
  double time, step;
};
void PrintTo(const Scene_& s, std::ostream* out) { *out << s.name; }
struct FluidLedger : testing::TestWithParam<Scene_> {};

TEST_P(FluidLedger, ClosesToRoundOffAndLeavesToTheSchemeWhatFallsWithTheSquareOfTheStep) {
  const auto& [name, make, time, step] = GetParam();
  const Account coarse = account(make(), time, step), fine = account(make(), time, 0.5 * step);
  EXPECT_LT(coarse.residual, 1e-12);
  EXPECT_LT(fine.residual, 1e-12);
  EXPECT_LT(fine.time_integration, 1e-3);
  EXPECT_GT(coarse.time_integration / fine.time_integration, 3.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FluidLedger,
                         testing::Values(Scene_{"column", falling_column, 0.3, 1e-3}, Scene_{"block", floating_block, 0.3, 2e-3},
                                         Scene_{"collision", head_on_collision, 1.0, 1e-3}),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// Clamped: an unclamped one tears itself apart.
lab::Lab printed_column() {
  lab::Lab lab = lab::column(8, 4, 5.0, 1000.0, 10.0, Mode::paper);
  lab.scene.modes[term::clamp] = Mode::corrected;
  return lab;
}

/// No energy stands behind (7): what it does is booked as work, and nothing of it is left to the scheme, however long the step.
TEST(FluidLedger, BooksThePrintedPressureAsWorkAndLeavesToTheSchemeOnlyWhatFallsWithTheSquareOfTheStep) {
  const Account coarse = account(printed_column(), 0.3, 1e-3), fine = account(printed_column(), 0.3, 5e-4);
  EXPECT_LT(coarse.residual, 1e-12);  // round-off of 300 steps
  EXPECT_LT(fine.residual, 1e-12);
  EXPECT_LT(coarse.time_integration, 1e-3);
  EXPECT_GT(coarse.time_integration / fine.time_integration, 3.0);
  lab::Lab lab = printed_column();
  lab.scene.time_step = 1e-3;
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.3);
  const Ledger end = s.ledger();
  EXPECT_EQ(end.energy.count("compression"), 0u);
  EXPECT_GT(std::abs(end.energy.at("pressure_work")), 100.0 * std::abs(end.energy.at("time_integration")));
}

}  // namespace
}  // namespace tripoint
