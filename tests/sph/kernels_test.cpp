// SPDX-License-Identifier: BSD-3-Clause
#include "sph/kernels.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace tripoint {
namespace {

constexpr double h = 0.37;  ///< any support radius [m]

/// Integral of f from 0 to h by Gauss-Legendre, 5 points on each of 4000 intervals: exact to round-off for
/// these kernels.
double integral(const std::function<double(double)>& f) {
  constexpr double x[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                          -0.9061798459386640};
  constexpr double w[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                          0.2369268850561891};
  constexpr int intervals = 4000;
  const double half = 0.5 * h / intervals;
  double sum = 0.0;
  for (int n = 0; n < intervals; ++n) {
    for (int k = 0; k < 5; ++k) sum += half * w[k] * f((2 * n + 1) * half + half * x[k]);
  }
  return sum;
}
double over_space(const std::function<double(double)>& f) {
  return integral([&](double r) { return 4.0 * std::numbers::pi * r * r * f(r); });
}
double over_plane(const std::function<double(double)>& f) {
  return integral([&](double r) { return 2.0 * std::numbers::pi * r * f(r) * layer_depth; });
}
constexpr double quadrature = 1e-12;
constexpr Dimensions plane = Dimensions::two;

TEST(Kernels, IntegrateToOneOverSpace) {
  EXPECT_NEAR(over_space([](double r) { return Poly6(h).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_space([](double r) { return Spiky(h).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_space([](double r) { return ViscosityKernel(h).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_space([](double r) { return ElasticityKernel(h).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_space([](double r) { return WendlandC2(h).value(r); }), 1.0, quadrature);
}

TEST(Kernels, IntegrateToOneOverThePlane) {
  EXPECT_NEAR(over_plane([](double r) { return Poly6(h, plane).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_plane([](double r) { return Spiky(h, plane).value(r); }), 1.0, quadrature);
  // its logarithm takes the quadrature more
  EXPECT_NEAR(over_plane([](double r) { return ViscosityKernel(h, plane).value(r); }), 1.0, 1e-7);
  EXPECT_NEAR(over_plane([](double r) { return ElasticityKernel(h, plane).value(r); }), 1.0, quadrature);
  EXPECT_NEAR(over_plane([](double r) { return WendlandC2(h, plane).value(r); }), 1.0, quadrature);
}

TEST(Kernels, HaveASecondMomentOfTheLaplacianOfOneInThePlane) {
  // 1/4 int r^2 lap W dA = 1
  EXPECT_NEAR(over_plane([](double r) { return r * r / 4.0 * ViscosityKernel(h, plane).laplacian(r); }), 1.0,
              quadrature);
  EXPECT_NEAR(
      over_plane([](double r) { return r * r / 4.0 * -2.0 * WendlandC2(h, plane).derivative_over_r(r); }),
      1.0, quadrature);
}

TEST(Kernels, HaveASecondMomentOfTheLaplacianOfOne) {
  // 1/6 int r^2 lap W dV = 1: the operator of (8) and (21) is exact for a parabola
  EXPECT_NEAR(over_space([](double r) { return r * r / 6.0 * ViscosityKernel(h).laplacian(r); }), 1.0,
              quadrature);
  EXPECT_NEAR(over_space([](double r) { return r * r / 6.0 * -2.0 * WendlandC2(h).derivative_over_r(r); }),
              1.0, quadrature);
}

TEST(Kernels, HaveDerivativesThatAreThoseOfTheirValues) {
  constexpr double d = 1e-6 * h;
  const auto slope = [](const auto& kernel, double r) {
    return (kernel.value(r + d) - kernel.value(r - d)) / (2.0 * d);
  };
  for (const double q : {0.1, 0.35, 0.6, 0.9}) {
    const double r = q * h, scale = 1.0 / (h * h * h * h);
    EXPECT_NEAR(slope(Spiky(h), r), Spiky(h).derivative(r), 1e-8 * scale);
    EXPECT_NEAR(slope(ElasticityKernel(h), r), ElasticityKernel(h).derivative(r), 1e-8 * scale);
    EXPECT_NEAR(slope(WendlandC2(h), r), WendlandC2(h).derivative(r), 1e-8 * scale);
    EXPECT_NEAR(WendlandC2(h).derivative_over_r(r) * r, WendlandC2(h).derivative(r), 1e-14 * scale);
  }
}

TEST(Kernels, HaveTheLaplacianOfTheViscosityKernelThatThePaperUses) {
  constexpr double d = 1e-4 * h;
  const ViscosityKernel w(h);
  for (const double q : {0.3, 0.6, 0.9}) {
    const double r = q * h;
    const double second = (w.value(r + d) - 2.0 * w.value(r) + w.value(r - d)) / (d * d),
                 first = (w.value(r + d) - w.value(r - d)) / (2.0 * d);
    EXPECT_NEAR((second + 2.0 * first / r) / w.laplacian(r), 1.0, 1e-5);  // central differences
  }
}

TEST(Kernels, VanishAtAndBeyondTheSupport) {
  for (const double r : {h, 1.0000001 * h, 3.0 * h}) {
    EXPECT_EQ(Poly6(h).value(r), 0.0);
    EXPECT_EQ(Spiky(h).value(r), 0.0);
    EXPECT_EQ(Spiky(h).derivative(r), 0.0);
    EXPECT_EQ(ViscosityKernel(h).laplacian(r), 0.0);
    EXPECT_EQ(ElasticityKernel(h).value(r), 0.0);
    EXPECT_EQ(WendlandC2(h).value(r), 0.0);
    EXPECT_EQ(WendlandC2(h).derivative_over_r(r), 0.0);
  }
}

TEST(Kernels, GiveTheValuesOfTheElasticityKernelThatFollowFrom17) {
  const ElasticityKernel w(h);
  EXPECT_NEAR(w.value(0.0) * h * h * h, 2.05158, 5e-6);                 // c (2h/pi), six digits
  EXPECT_NEAR(w.derivative(0.0) * h * h * h * h, -3.222611689, 5e-10);  // -c
}

}  // namespace
}  // namespace tripoint
