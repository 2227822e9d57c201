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
  double density_poly6, density_elastic, density_wendland, gradient_spiky, gradient_elastic,
      gradient_wendland, laplacian;
};
constexpr Row table[] = {{1.5, 18, 0.949, 1.126, 1.260, 0.681, 0.960, 0.665, 1.060},
                         {2.0, 26, 1.010, 1.072, 1.034, 0.956, 0.985, 0.982, 0.988},
                         {2.12, 32, 1.015, 1.056, 1.027, 0.959, 0.952, 1.000, 0.943},
                         {2.3, 56, 1.008, 1.026, 1.021, 0.943, 0.934, 0.994, 0.928},
                         {2.5, 80, 0.995, 1.012, 1.013, 0.950, 1.001, 0.979, 1.021},
                         {3.0, 92, 1.002, 1.014, 1.003, 0.990, 0.967, 1.001, 0.956},
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
  EXPECT_NEAR(paper_heat_rate(1.0, q, {k, 0.0, 0.0}) / (k * k),
              viscosity_moments(q).laplacian / poly6_moments(q).density, 1e-6);
}

TEST(Lattice, PaperHeatRateIsTheMeasuredOneAtTenParticlesAWave) {
  const double k = 2.0 * std::numbers::pi / 10.0;
  EXPECT_NEAR(paper_heat_rate(1.0, 2.12, {k, 0.0, 0.0}) / (k * k), 0.892, three_digits);
  // Any unit of length
  EXPECT_NEAR(paper_heat_rate(0.01, 0.025, {100.0 * k, 0.0, 0.0}) / (1e4 * k * k), 0.954, three_digits);
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

/// Sums in NumPy.
TEST(Lattice, HasTheKernelOfAnInterface) {
  const InterfaceKernel K = interface_kernel(2.6);
  EXPECT_NEAR(K.constant, 2.2392876, 1e-7);
  EXPECT_NEAR(K.square, -0.42923285, 1e-7);
  EXPECT_NEAR(interface_kernel(2.0).constant, 1.35180201, 1e-7);
  EXPECT_EQ(interface_kernel(2.0).square, 0.0) << "a second layer sees nothing of the other liquid";
}

/// Layers at -2.5 .. 2.5 of liquids of densities 5 below 0 and 1 above it, at their exact pressures: what
/// pairs give each layer is its weight, with the energy of unlike pairs.
TEST(Lattice, LeavesTheLayersBesideAnInterfaceAtRest) {
  for (const double q : {2.05, 2.3, 2.6, 3.0}) {
    const WendlandC2 W(q);
    const InterfaceKernel K = interface_kernel(q);
    const auto density = [](double z) { return z < 0.0 ? 5.0 : 1.0; };
    const double M = wendland_moments(q).gradient;
    for (const double z : {-1.5, -0.5, 0.5, 1.5}) {
      double force = 0.0, plain = 0.0;
      for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y)
          for (int n = -3; n <= 3; ++n) {
            const double r = std::hypot(x, y, n), other = z + n;
            if (r == 0.0 || r >= q) continue;
            plain += (-density(z) * z - density(other) * other) / M * W.derivative_over_r(r) * n;
            const double a = 0.5 * (density(z) - density(other)) / M;
            force += a * (-K.value(W, r) - n * K.derivative_over_r(W, r) * n);  // gravity is -1
          }
      EXPECT_NEAR(plain + force, density(z), 1e-12) << q << " " << z;
      if (std::abs(z) < 1.0) {
        // a quarter of the difference of densities
        EXPECT_GT(std::abs(plain - density(z)), 0.9) << q << " " << z;
      }
    }
  }
}

TEST(LatticeOfThePlane, HasTheNeighboursOfALayer) {
  EXPECT_EQ(wendland_moments(2.6, Dimensions::two).neighbours, 20);
  EXPECT_EQ(wendland_moments(3.2, Dimensions::two).neighbours, 36);
}

/// A support of many spacings leaves the integrals over the plane.
TEST(LatticeOfThePlane, TendsToTheContinuum) {
  constexpr double many = 40.0;
  for (const LatticeMoments& m :
       {poly6_moments(many, Dimensions::two), spiky_moments(many, Dimensions::two),
        elasticity_moments(many, Dimensions::two), wendland_moments(many, Dimensions::two)})
    EXPECT_NEAR(m.density, 1.0, 1e-3);
  EXPECT_NEAR(wendland_moments(many, Dimensions::two).gradient, 1.0, 1e-3);
  EXPECT_NEAR(spiky_moments(many, Dimensions::two).gradient, 1.0, 1e-3);
  EXPECT_NEAR(viscosity_moments(many, Dimensions::two).laplacian, 1.0, 1e-3);
  const ShearModuli shear = shear_moduli(many, {1.0, 0.0}, Dimensions::two);
  EXPECT_NEAR(shear.axes, 1.0, 1e-3);
  EXPECT_NEAR(shear.diagonals, 1.0, 1e-3);
}

TEST(LatticeOfThePlane, ResistsAllShearsAlikeByItsWeight) {
  for (const double q : {2.6, 3.0, 3.2}) {
    const ShearModuli shear = shear_moduli(q, isotropic_shear(q, Dimensions::two), Dimensions::two);
    EXPECT_NEAR(0.5 * (shear.axes + shear.diagonals), 1.0, 1e-12) << q;
  }
}

}  // namespace
}  // namespace tripoint
