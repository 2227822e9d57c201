// SPDX-License-Identifier: BSD-3-Clause
// (24) and its gradient against the density kernel of src/sph, summed plainly.
#include "surface/local_mean.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/machine.hpp"
#include "sph/kernels.hpp"
#include "surface/mean_sums.hpp"

namespace tripoint {
template <>
MeanSumsFunction mean_sums_for<Avx2>();

namespace {

constexpr double ir = 2.6;

std::vector<Vec3> cloud(std::uint64_t seed, int n) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> in(-2.0, 2.0);
  std::vector<Vec3> places(static_cast<std::size_t>(n));
  for (Vec3& r : places) r = {in(random), in(random), in(random)};
  return places;
}

NearPoints near_of(const std::vector<Vec3>& places) {
  NearPoints p;
  PointCells(places, 10.0).gather({0, 0, 0}, 20.0, p);
  return p;
}

/// rbar(r) as (24) says it, with r_j in the numerator.
Vec3 plain_mean(const std::vector<Vec3>& places, const Vec3& r) {
  const Poly6 W(ir);
  Vec3 sum;
  double weights = 0.0;
  for (const Vec3& r_j : places) {
    const double w = W.value(norm(r - r_j));
    sum += w * r_j;
    weights += w;
  }
  return sum / weights;
}

TEST(LocalMean, IsTheMeanOfThePlacesWeightedByTheDensityKernel) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto places = cloud(seed, 30);
    const Vec3 r{0.3, -0.2, 0.1};
    const LocalMean m = local_mean(near_of(places), r, ir);
    EXPECT_LT(norm(r + m.offset - plain_mean(places, r)), 1e-13);  // round-off of 30 terms of about 1
    double weights = 0.0;
    for (const Vec3& r_j : places) weights += Poly6(ir).value(norm(r - r_j)) / Poly6(ir).value(0.0);
    EXPECT_NEAR(m.weight, weights, 1e-13 * weights);
  }
}

TEST(LocalMean, HasTheGradientOfTheMean) {
  const auto places = cloud(3, 25);
  const Vec3 r{-0.4, 0.5, 0.2};
  const Matrix3 J = local_mean(near_of(places), r, ir).gradient;
  const double d = 1e-5, tolerance = 1e-8;  // of central differences: d^2 and round-off/d
  const auto column = [&](const Vec3& step) {
    return (plain_mean(places, r + step) - plain_mean(places, r - step)) / (2.0 * d);
  };
  const Vec3 x = column({d, 0, 0}), y = column({0, d, 0}), z = column({0, 0, d});
  EXPECT_LT(norm(Vec3{J.xx, J.yx, J.zx} - x), tolerance);
  EXPECT_LT(norm(Vec3{J.xy, J.yy, J.zy} - y), tolerance);
  EXPECT_LT(norm(Vec3{J.xz, J.yz, J.zz} - z), tolerance);
  EXPECT_GT(std::abs(J.xy - J.yx), 1e-4)
      << "not symmetric in general: a transposed gradient would not be seen";
}

TEST(LocalMean, OfOneParticleIsThatParticleWhereverOneLooks) {
  const LocalMean m = local_mean(near_of({{0.5, 0.0, 0.0}}), {0.0, 0.0, 0.0}, ir);
  EXPECT_NEAR(m.offset.x, 0.5, 1e-15);
  EXPECT_LT(norm(Vec3{m.gradient.xx, m.gradient.yy, m.gradient.zz}), 1e-14);
}

TEST(LocalMean, OfNothingSaysSo) {
  EXPECT_EQ(local_mean(near_of({{9.0, 0.0, 0.0}}), {0.0, 0.0, 0.0}, ir).weight, 0.0);
  EXPECT_EQ(local_mean(NearPoints{}, {0.0, 0.0, 0.0}, ir).weight, 0.0);
}

TEST(LocalMean, HasTheSameBitsOnEveryVectorUnit) {
  if (!machine_has_avx2()) GTEST_SKIP() << "this machine has no AVX2";
  const NearPoints p = near_of(cloud(5, 61));
  const PlaceColumns columns{p.x.data(), p.y.data(), p.z.data(), p.x.size()};
  const MeanSums a = mean_sums<Any>(columns, {0.1, 0.2, 0.3}, 1.0 / ir),
                 b = mean_sums_for<Avx2>()(columns, {0.1, 0.2, 0.3}, 1.0 / ir);
  EXPECT_TRUE(a.w == b.w && a.wy == b.wy && a.uy == b.uy && a.uyy == b.uyy);
}

}  // namespace
}  // namespace tripoint
