// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "references/liquids.hpp"
#include "validation/references/collapse_mesh.hpp"

namespace tripoint {
namespace {

using test::pi;

constexpr LiquidColumn unit{1.0, 2.0, 1.0};

/// Pressure in the first instant, over density gravity width: Laplace's equation with no pressure on the free
/// sides, as a series.
double first_pressure(double x, double y) {
  double p = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double k = (n + 0.5) * pi, sign = n % 2 == 0 ? 1.0 : -1.0;
    // sinh(k (h - y))/cosh(k h), written so that nothing overflows
    p += sign * 2.0 / (k * k) * std::cos(k * x) *
         (std::exp(-k * y) - std::exp(-k * (2.0 * unit.height - y))) /
         (1.0 + std::exp(-2.0 * k * unit.height));
  }
  return p;
}

TEST(Collapse, BeginsWithThePressureOfLaplacesEquation) {
  double coarse = 0.0;
  for (const int cells : {10, 20, 40}) {
    CollapseMesh mesh(unit, cells);
    mesh.step();
    double greatest = 0.0;
    for (int i = 0; i < mesh.cells()[0]; ++i)
      for (int j = 0; j < mesh.cells()[1]; ++j)
        greatest = std::max(
            greatest, std::abs(mesh.pressure(i, j) - first_pressure((i + 0.5) / cells, (j + 0.5) / cells)));
    EXPECT_LT(greatest, 0.12 / cells);  // first order at the corner where the free side meets the floor
    if (coarse > 0.0) {
      EXPECT_LT(greatest, 0.7 * coarse);
    }
    coarse = greatest;
  }
}

TEST(Collapse, ItsTopFallsAsLaplacesEquationSays) {
  double gravity_left = 1.0;
  for (int n = 0; n < 20; ++n) {
    const double k = (n + 0.5) * pi;
    gravity_left -= (n % 2 == 0 ? 1.0 : -1.0) * 2.0 / (k * std::cosh(k * unit.height));
  }
  CollapseMesh mesh(unit, 20);
  while (mesh.time() < 0.05) mesh.step();
  EXPECT_NEAR((unit.height - mesh.top()) / (0.5 * mesh.time() * (mesh.time() + mesh.step_size())),
              gravity_left, 0.002);
}

TEST(Collapse, KeepsEnergyAndEveryArea) {
  CollapseMesh mesh(unit, 20);
  while (mesh.time() < 1.8) mesh.step();
  EXPECT_LT(mesh.greatest_area_error(), 1e-9);
  EXPECT_NEAR(mesh.energy(), 1.0, 1e-3);
}

/// [Ritter 1892]
TEST(Collapse, ItsTipComesToTheSpeedOfShallowWater) {
  CollapseMesh mesh(unit, 10);
  while (mesh.time() < 4.5) mesh.step();
  const double place = mesh.front(), time = mesh.time();
  while (mesh.time() < 6.0) mesh.step();
  EXPECT_NEAR((mesh.front() - place) / (mesh.time() - time), 2.0 * std::sqrt(unit.height),
              0.02 * 2.0 * std::sqrt(unit.height));
}

TEST(Collapse, ItsFrontHasAllButConvergedAndTheDampingDoesNotMoveIt) {
  const std::vector<double> times{0.862, 1.412, 1.801};
  const auto fine = collapse_fronts(unit, 32, times), usual = collapse_fronts(unit, 20, times);
  for (std::size_t n = 0; n < times.size(); ++n) {
    EXPECT_NEAR(usual.front[n], fine.front[n], 0.015);
    EXPECT_LT(usual.difference[n], 0.03);
    EXPECT_GT(usual.difference[n], 0.0);
  }
  for (const double damping : {0.3, 3.0}) {
    CollapseMesh mesh(unit, 20, damping);
    while (mesh.time() < times.back()) mesh.step();
    EXPECT_NEAR(mesh.front(), usual.front.back(), 0.01) << damping;
  }
}

TEST(Collapse, HasNoUnitOfItsOwn) {
  const LiquidColumn small{0.05, 0.1, 9.81};
  const double unit_of_time = std::sqrt(small.width / small.gravity);
  const auto one = collapse_fronts(unit, 10, {0.5, 1.5}),
             other = collapse_fronts(small, 10, {0.5 * unit_of_time, 1.5 * unit_of_time});
  for (const std::size_t n : {0u, 1u}) EXPECT_NEAR(other.front[n] / small.width, one.front[n], 1e-9);
}

TEST(Collapse, KnowsThePressureAtAPlaceOfTheFirstInstantAndAsTheMeshIsRefined) {
  for (const double x : {0.1, 0.3, 0.62})
    for (const double y : {0.1, 0.5, 1.21}) {
      CollapseMesh mesh(unit, 40);
      mesh.step();
      EXPECT_NEAR(mesh.pressure_at(x, y), first_pressure(x, y), 0.003) << x << " " << y;
    }
  const auto p = collapse_pressures(unit, 20, {0.3, 0.9, 1.5}, 0.1, 0.1),
             fine = collapse_pressures(unit, 32, {0.3, 0.9, 1.5}, 0.1, 0.1);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(p.pressure[n], fine.pressure[n], 2.0 * p.difference[n] + 0.002) << n;
    EXPECT_LT(p.difference[n], 0.03) << n;
  }
  EXPECT_LT(p.pressure[0], p.pressure[1]) << "what falls freely at first is held up by the floor later";
}

TEST(Collapse, SaysWhereTheMeshDoesNotLast) {
  EXPECT_THROW((void)collapse_fronts(unit, 20, {20.0}), InputError);
}

}  // namespace
}  // namespace tripoint
