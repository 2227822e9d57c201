// SPDX-License-Identifier: BSD-3-Clause
#include "surface/detector.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace tripoint {
namespace {

double by_eigen(const Matrix3& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz;
  return m.eigenvalues().real().maxCoeff();
}

TEST(Detector, IsThePolynomialOfThePaper) {
  EXPECT_EQ(detector_factor(0.0), 1.0);
  EXPECT_EQ(detector_factor(0.4), 1.0);
  EXPECT_EQ(detector_factor(2.0), 0.0);
  EXPECT_EQ(detector_factor(7.0), 0.0);
  const double g = (2.0 - 1.2) / 1.6;  // (26)
  EXPECT_NEAR(detector_factor(1.2), g * g * g - 3.0 * g * g + 3.0 * g, 1e-15);
  // Of a flat surface, whose greatest eigenvalue is 1: the shift along it
  EXPECT_NEAR(detector_factor(1.0), 0.947265625, 1e-15);
}

TEST(Detector, LeavesTheLowLimitWithoutAKink) {
  const double d = 1e-4, at = 0.4;
  const double slope = (detector_factor(at + d) - detector_factor(at - d)) / (2.0 * d);
  const double bend =
      (detector_factor(at + d) - 2.0 * detector_factor(at) + detector_factor(at - d)) / (d * d);
  EXPECT_NEAR(slope, 0.0, 1e-8);  // f - 1 = -(EV - t_low)^3/1.6^3
  EXPECT_NEAR(bend, 0.0, 1e-3);
  EXPECT_GT(detector_factor(1.9), 0.0);
}

TEST(Detector, FindsTheLargestEigenvalueOfAnyMatrix) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  for (int n = 0; n < 2000; ++n) {
    Matrix3 a{in(random), in(random), in(random), in(random), in(random),
              in(random), in(random), in(random), in(random)};
    if (n % 3 == 0) a = 0.5 * (a + transposed(a));
    EXPECT_NEAR(largest_eigenvalue(a), by_eigen(a), 1e-9);
  }
}

TEST(Detector, FindsItWhereEigenvaluesCoincide) {
  EXPECT_NEAR(largest_eigenvalue(identity3), 1.0, 1e-15);
  EXPECT_NEAR(largest_eigenvalue(Matrix3{}), 0.0, 1e-15);
  // a root of two: half of the digits
  EXPECT_NEAR(largest_eigenvalue({1, 0, 0, 0, 1, 0, 0, 0, 0.4}), 1.0, 1e-8);
  EXPECT_NEAR(largest_eigenvalue({0, -1, 0, 1, 0, 0, 0, 0, -2}), 0.0, 1e-9);  // a pair +-i: its real part
}

}  // namespace
}  // namespace tripoint
