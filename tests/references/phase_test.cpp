// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "references/melting.hpp"
#include "references/solids.hpp"
#include "validation/references/neumann.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::function;

TEST(Neumann, HasThePrintedSolutionsOfStefansProblem) {
  const double printed[][2] = {{0.1, 0.22002}, {0.5, 0.46479}, {1.0, 0.62006}, {2.0, 0.80060}};
  for (const auto& [stefan, lambda] : printed)
    EXPECT_NEAR((NeumannFront{300 + 50 * stefan, 300, 300, 1e-6, 50}.lambda()), lambda, 5e-6) << stefan;
}

TEST(Neumann, BalancesTheHeatAtTheFrontByItsOwnDifferences) {
  for (const NeumannFront& f :
       {NeumannFront{400, 300, 300, 2e-6, 100}, NeumannFront{400, 300, 250, 2e-6, 100},
        NeumannFront{250, 290, 340, 2e-6, 50}}) {
    const double t = 30.0, X = f.front(t), h = 1e-7, flow = f.surface > f.far ? 1.0 : -1.0;
    const double before = (f.temperature(X - h, t) - f.temperature(X - 2 * h, t)) / h,
                 after = (f.temperature(X + 2 * h, t) - f.temperature(X + h, t)) / h;
    const double speed = (f.front(t + 1e-3) - f.front(t - 1e-3)) / 2e-3;
    EXPECT_NEAR(-f.diffusivity * (before - after), flow * f.latent_over_capacity * speed,
                1e-4 * f.latent_over_capacity * speed);  // one-sided, h/X
    EXPECT_NEAR(f.temperature(0.0, t), f.surface, 1e-12);
    EXPECT_NEAR(f.temperature(X * (1 - 1e-12), t), f.change, 1e-8);
    EXPECT_NEAR(f.temperature(40 * X, t), f.far, 1e-8);
    for (const double x : {0.4 * X, 2.0 * X}) {
      const double d = 1e-5, T = f.temperature(x, t),
                   curvature = (f.temperature(x + d, t) + f.temperature(x - d, t) - 2 * T) / (d * d);
      EXPECT_NEAR((f.temperature(x, t + 0.01) - f.temperature(x, t - 0.01)) / 0.02, f.diffusivity * curvature,
                  1e-4);  // of rates of 1 K/s
    }
  }
}

TEST(Neumann, BalancesTheHeatAtTheFrontOfUnlikePhases) {
  for (NeumannFront f : {NeumannFront{253, 273, 283, 1.05e-6, 159}, NeumannFront{400, 300, 250, 2e-6, 100}}) {
    f.far_diffusivity_ratio = 0.13;
    f.far_conductivity_ratio = 0.25;
    const double t = 30.0, X = f.front(t), h = 1e-7, flow = f.surface > f.far ? 1.0 : -1.0;
    const double before = (f.temperature(X - h, t) - f.temperature(X - 2 * h, t)) / h,
                 after = (f.temperature(X + 2 * h, t) - f.temperature(X + h, t)) / h;
    const double speed = (f.front(t + 1e-3) - f.front(t - 1e-3)) / 2e-3;
    EXPECT_NEAR(-f.diffusivity * (before - 0.25 * after), flow * f.latent_over_capacity * speed,
                1e-4 * f.latent_over_capacity * speed);  // k over rho c of the surface's phase
    EXPECT_NEAR(f.temperature(X * (1 + 1e-12), t), f.change, 1e-8);
    for (const double x : {0.4 * X, 1.5 * X}) {
      const double d = 1e-5, T = f.temperature(x, t),
                   curvature = (f.temperature(x + d, t) + f.temperature(x - d, t) - 2 * T) / (d * d);
      EXPECT_NEAR((f.temperature(x, t + 0.01) - f.temperature(x, t - 0.01)) / 0.02,
                  (x < X ? 1.0 : 0.13) * f.diffusivity * curvature, 1e-4);
    }
  }
}

TEST(Stefan, TakesThePropertiesOfEachPhase) {
  auto s = test::stefan_bar({230.0, 300.0, true});
  auto& m = s.job.scene.materials[0];
  m.solid_conductivity = 8.0;
  m.solid_heat_capacity = 500.0;  // ice of 1.6e-5 m2/s from water of 2e-6 m2/s, changing at 290 K
  s.job.scene.end_time = 1.0;
  const auto bar = make_reference(function("stefan"), s.job, s.initial);
  NeumannFront front{230.0, 290.0, 300.0, 8.0 / 5e5,
                     (1e5 - 500.0 * 10.0) / 500.0};  // 10 K below t_melt the liquid holds 500 J/kg/K more
  front.far_diffusivity_ratio = 2e-6 / 1.6e-5;
  front.far_conductivity_ratio = 0.25;
  EXPECT_NEAR(*bar->number("lambda"), front.lambda(), 1e-12);
  EXPECT_NEAR(*bar->number_at("front_position", 1.0), front.front(1.0), 1e-15);
}

TEST(Stefan, TakesBarAndWallFromTheScene) {
  const auto s = test::stefan_bar({});
  const auto bar = make_reference(function("stefan"), s.job, s.initial);
  const double X = 2 * 0.62006 * std::sqrt(2e-6 * 20);
  EXPECT_NEAR(*bar->number_at("front_position", 20.0), X, 1e-5 * X);
  EXPECT_EQ(bar->measuring().melts, true);
  const auto end = bar->at(20.0);
  double melted = 0.0;
  for (std::size_t i = 0; i < s.initial.size(); ++i)
    melted += s.initial.source[i] == 0 ? 1e-9 * end.liquid_fraction[i] : 0.0;
  EXPECT_NEAR(melted / *bar->number("area"), *bar->number_at("front_position", 20.0), 1e-15);
  EXPECT_EQ(end.phase[0], 0);
  EXPECT_EQ(end.phase[4 * 39], 2);
  EXPECT_NEAR(end.temperature[4 * 39], 300.0, 1e-12);
  EXPECT_EQ(end.temperature.back(), 400.0);
}

TEST(Stefan, FreezesFromAColdWallAtTheHighEnd) {
  const auto s = test::stefan_bar({230.0, 300.0, true});
  const auto bar = make_reference(function("stefan"), s.job, s.initial);
  EXPECT_EQ(bar->measuring().melts, false);
  const auto end = bar->at(20.0);
  EXPECT_EQ(end.phase[0], 0);
  EXPECT_EQ(end.phase[4 * 39], 2);  // beside the wall
  EXPECT_EQ(end.liquid_fraction[4 * 39], 0.0);
  EXPECT_LT(end.temperature[4 * 39], 240.0);
}

TEST(Stefan, RefusesABarThatIsTooShort) {
  auto s = test::stefan_bar({});
  s.job.scene.end_time = 1000.0;
  EXPECT_THROW((void)make_reference(function("stefan"), s.job, s.initial), InputError);
  // Hotter than the bar, below the melting point
  const auto between = test::stefan_bar({299.0, 295.0, false});
  EXPECT_THROW((void)make_reference(function("stefan"), between.job, between.initial), InputError);
}

TEST(Hysteresis, RemembersTheLastThresholdPassed) {
  const auto s = test::heated_block();
  const auto loop = make_reference(function("hysteresis"), s.job, s.initial);
  const double times[] = {0.5, 1.5, 2.5, 3.5, 4.5};
  const int phases[] = {1, 0, 0, 1, 1};
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(loop->at(times[n]).phase[3], phases[n]) << times[n];
  auto part = s;
  part.job.scene.events[0].region = Shape{};
  EXPECT_THROW((void)make_reference(function("hysteresis"), part.job, part.initial), InputError);
}

TEST(KnownStretch, OfASpinningRodIsTheSumOfThePullOfItsParts) {
  auto s = test::beam(0.0);
  s.job.bodies[0].angular_velocity = {0, 0, 3};
  const double E = 2e6;
  const int n = 2000;
  double stretch = 0.0;  // strain at x is the pull of all that lies farther out, rho w^2 x dx each, over E
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) * 0.095 / n;
    stretch += 1000 * 9 * 0.5 * (0.1 * 0.1 - x * x) / E / n;
  }
  EXPECT_NEAR(*make_reference(function("spinning_rod"), s.job, s.initial)->number("stretch"), 1.0 + stretch,
              1e-10);
  s.job.bodies[0].angular_velocity = {3, 0, 0};
  EXPECT_THROW((void)make_reference(function("spinning_rod"), s.job, s.initial), InputError);
}

TEST(KnownStretch, OfAPressedBlockIsWhereItsEnergyAndThePressuresWorkAreLeast) {
  auto s = test::beam(0.0);
  const double E = 2e6, nu = 0.3975, p = 2e4, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)),
               mu = E / (2 * (1 + nu));
  // Strains, relaxed one after the other: d/de_i of lambda/2 (sum e)^2 + mu sum e^2 + p sum e = 0
  double e[3] = {};
  for (int n = 0; n < 400; ++n)
    for (int i = 0; i < 3; ++i) e[i] = -(p + lambda * (e[(i + 1) % 3] + e[(i + 2) % 3])) / (lambda + 2 * mu);
  EXPECT_NEAR(
      *make_reference(function("pressed_block", {{"pressure", p}}), s.job, s.initial)->number("stretch"),
      1.0 + e[0], 1e-12);
}

}  // namespace
}  // namespace tripoint
