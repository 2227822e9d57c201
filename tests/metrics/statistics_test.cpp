// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "validation/metrics/order.hpp"
#include "validation/metrics/statistics.hpp"

namespace tripoint {
namespace {

/// x[n+1] = a x[n] + noise about `mean`: the variance of the mean of n samples is (1 + a)/(1 - a) that of
/// white noise.
std::vector<double> correlated(std::size_t n, double a, double mean, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, std::sqrt(1.0 - a * a));
  std::vector<double> x;
  double value = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    value = a * value + noise(engine);
    x.push_back(mean + value);
  }
  return x;
}

TEST(StationaryMean, OfWhiteNoiseHasTheErrorOfItsCount) {
  const auto m = stationary_mean(correlated(4096, 0.0, 5.0, 1));
  EXPECT_NEAR(m.uncertainty, 1.0 / 64.0,
              0.5 / 64.0);  // the error of the error, from eight blocks: 1/sqrt(14), and the largest is taken
  EXPECT_NEAR(m.value, 5.0, 4.0 * m.uncertainty);
}

TEST(StationaryMean, CorrelationIsNotTakenForKnowledge) {
  constexpr double a = 0.96;  // 49 samples for an independent one
  double naive = 0.0, stated = 0.0, true_square = 0.0;
  constexpr int runs = 40;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const auto x = correlated(8192, a, 2.0, seed);
    const auto m = stationary_mean(x);
    stated += m.uncertainty / runs;
    true_square += (m.value - 2.0) * (m.value - 2.0) / runs;
    naive += 1.0 / std::sqrt(8192.0) / runs;
  }
  EXPECT_GT(std::sqrt(true_square) / naive, 5.0);  // what a naive standard error would claim
  EXPECT_NEAR(stated / std::sqrt(true_square), 1.0,
              0.35);  // 40 runs know the true scatter to 11 %, the largest of the blocks errs high
}

TEST(StationaryMean, TheBurnInIsCut) {
  auto x = correlated(1024, 0.5, 1.0, 3);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 20.0 * std::exp(-static_cast<double>(i) / 20.0);
  const auto m = stationary_mean(x);
  EXPECT_GT(m.burn_in, 60u);  // three decay times leave 1, the size of the noise
  EXPECT_LT(m.burn_in, 300u);
  EXPECT_NEAR(m.value, 1.0, 4.0 * m.uncertainty);
}

TEST(StationaryMean, ATrendNeverReachesAPlateau) {
  std::vector<double> x;
  for (int i = 0; i < 512; ++i) x.push_back(i);
  EXPECT_FALSE(stationary_mean(x).plateau);
  EXPECT_TRUE(std::isnan(stationary_mean({1.0, 2.0, 3.0}).value));
}

TEST(GridConvergence, EveryLevelHasItsUncertaintyAndItCoversTheTrueError) {
  const std::vector<double> h{0.4, 0.2, 0.1, 0.05};
  std::vector<double> value;
  for (const double x : h) value.push_back(3.0 + 0.7 * x * x);
  const auto u = grid_convergence_uncertainties(h, value, 2.0);
  ASSERT_EQ(u.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(2.0 * u[k], 1.25 * 0.7 * h[k] * h[k], 1e-6);  // exactly second order: the safety factor alone
  EXPECT_EQ(u.back(), grid_convergence_uncertainty(h, value, 2.0));
  for (const double x : grid_convergence_uncertainties(h, value, 0.0)) EXPECT_TRUE(std::isnan(x));
}

}  // namespace
}  // namespace tripoint
