// SPDX-License-Identifier: BSD-3-Clause
#include "sph/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

/// Sums over the cubic lattice, computed apart from this code to three digits.
struct Row {
  double q;
  int neighbours;
  double density_poly6, density_elastic, density_wendland, gradient_spiky, gradient_elastic, gradient_wendland, laplacian;
};
constexpr Row table[] = {
    {1.5, 18, 0.949, 1.126, 1.260, 0.681, 0.960, 0.665, 1.060},  {2.0, 26, 1.010, 1.072, 1.034, 0.956, 0.985, 0.982, 0.988},
    {2.12, 32, 1.015, 1.056, 1.027, 0.959, 0.952, 1.000, 0.943}, {2.3, 56, 1.008, 1.026, 1.021, 0.943, 0.934, 0.994, 0.928},
    {2.5, 80, 0.995, 1.012, 1.013, 0.950, 1.001, 0.979, 1.021},  {3.0, 92, 1.002, 1.014, 1.003, 0.990, 0.967, 1.001, 0.956},
    {4.0, 250, 1.000, 1.0045, 1.001, 0.997, 1.005, 0.999, 1.008}};
constexpr double three_digits = 5.01e-4;

struct Lattice : testing::TestWithParam<Row> {};
TEST_P(Lattice, SumsAreTheTabledOnes) {
  const Row& row = GetParam();
  EXPECT_EQ(poly6_moments(row.q).neighbours, row.neighbours);
  EXPECT_NEAR(poly6_moments(row.q).density, row.density_poly6, three_digits);
  EXPECT_NEAR(elasticity_moments(row.q).density, row.density_elastic, three_digits);
  EXPECT_NEAR(wendland_moments(row.q).density, row.density_wendland, three_digits);
  EXPECT_NEAR(spiky_moments(row.q).gradient, row.gradient_spiky, three_digits);
  EXPECT_NEAR(elasticity_moments(row.q).gradient, row.gradient_elastic, three_digits);
  EXPECT_NEAR(wendland_moments(row.q).gradient, row.gradient_wendland, three_digits);
  EXPECT_NEAR(viscosity_moments(row.q).laplacian, row.laplacian, three_digits);
}
INSTANTIATE_TEST_SUITE_P(Supports, Lattice, testing::ValuesIn(table));

TEST(Lattice, PaperHeatRateTendsToItsFloorForLongWaves) {
  const double q = 2.12, k = 1e-3;
  EXPECT_NEAR(paper_heat_rate(1.0, q, {k, 0.0, 0.0}) / (k * k), viscosity_moments(q).laplacian / poly6_moments(q).density, 1e-6);
}

TEST(Lattice, PaperHeatRateIsTheMeasuredOneAtTenParticlesAWave) {
  const double k = 2.0 * std::numbers::pi / 10.0;
  EXPECT_NEAR(paper_heat_rate(1.0, 2.12, {k, 0.0, 0.0}) / (k * k), 0.892, three_digits);
  EXPECT_NEAR(paper_heat_rate(0.01, 0.025, {100.0 * k, 0.0, 0.0}) / (1e4 * k * k), 0.954, three_digits);  // any unit of length
}

/// Sums in NumPy.
TEST(Lattice, ResistsShearUnlikeAlongAxesAndDiagonals) {
  const ShearModuli m = shear_moduli(2.6, {1.0, 0.0});
  EXPECT_NEAR(m.axes, 0.88742, 1e-5);
  EXPECT_NEAR(m.diagonals, 1.16887, 1e-5);
}

TEST(Lattice, ResistsShearAlikeUnderTheWeightOfIsotropicShear) {
  for (const double q : {2.3, 2.4, 2.5, 2.6}) {
    const ShearModuli m = shear_moduli(q, isotropic_shear(q));
    EXPECT_NEAR(m.axes, 1.0, 1e-12) << q;
    EXPECT_NEAR(m.diagonals, 1.0, 1e-12) << q;
  }
}

TEST(Lattice, NeverDrivesAPairByTheWeightOfIsotropicShear) {
  for (double q = 1.6; q < 4.0; q += 0.05) {
    const ShearWeight w = isotropic_shear(q);
    EXPECT_GE(w.constant, 0.0) << q;
    EXPECT_GT(w.square, 0.0) << q;
    const ShearModuli m = shear_moduli(q, w), before = shear_moduli(q, {1.0, 0.0});
    EXPECT_NEAR(0.6 * m.axes + 0.4 * m.diagonals, 1.0, 1e-12) << q;
    EXPECT_LE(std::abs(m.axes - m.diagonals), std::abs(before.axes - before.diagonals)) << q;
  }
}

}  // namespace
}  // namespace tripoint
