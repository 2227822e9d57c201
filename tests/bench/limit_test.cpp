// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "program/bench/limit.hpp"
#include "program/bench/measure.hpp"

namespace tripoint::bench {
namespace {

/// A lattice of unit spacing, shaken by up to 0.15.
std::vector<Vec3> shaken_lattice(int across) {
  std::vector<Vec3> x;
  unsigned state = 1;
  const auto shake = [&] {
    return 0.3 * (static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0 - 0.5);
  };
  for (int k = 0; k < across; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) x.push_back({i + shake(), j + shake(), k + shake()});
  return x;
}

double pairs_within(const std::vector<Vec3>& x, double support) {
  double pairs = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      if (i != j && dot(x[i] - x[j], x[i] - x[j]) < support * support) pairs += 1.0;
  return pairs;
}

TEST(Limit, CountsEveryPairWithinTheSupportWhateverTheSkin) {
  const std::vector<Vec3> x = shaken_lattice(9);
  for (const double skin : {0.0, 0.2}) {
    Limit limit(x, Mode::paper, 2.2, skin, 1);
    limit.round();
    EXPECT_EQ(limit.pairs(), pairs_within(x, 2.2)) << skin;
  }
}

TEST(Limit, LoopsHaveTheSameBitsOnEveryVectorUnitAndAnyThreads) {
  for (const Mode mode : {Mode::paper, Mode::corrected}) {
    Limit limit(shaken_lattice(9), mode, 2.2, 0.2, 1);
    const std::vector<double> alone = limit.sums(0);
    double sum = 0.0;
    for (const double v : alone) sum += std::abs(v);
    EXPECT_GT(sum, 0.0);
    for (std::size_t unit = 0; unit < limit.units(); ++unit) EXPECT_EQ(limit.sums(unit), alone) << unit;
    Limit shared(shaken_lattice(9), mode, 2.2, 0.2, 3);
    EXPECT_EQ(shared.sums(0), alone);
  }
}

TEST(Limit, DensityOfThePaperIsTheSumOverAllPairs) {
  const std::vector<Vec3> x = shaken_lattice(6);
  Limit limit(x, Mode::paper, 2.2, 0.1, 1);
  double expected = 0.0;
  for (const Vec3& a : x)
    for (const Vec3& b : x) expected += std::pow(std::max(0.0, 2.2 * 2.2 - dot(a - b, a - b)), 3);
  double found = 0.0;
  for (const double v : limit.density(limit.units() - 1)) found += v;
  EXPECT_NEAR(found / expected, 1.0, 1e-13);  // round-off of 1e4 sums
}

TEST(Limit, StepsCostLessTheLongerListsLast) {
  Limit limit(shaken_lattice(12), Mode::paper, 2.2, 0.2, 1);
  limit.round();
  EXPECT_GT(limit.best(1.0).step(1.0), limit.best(0.1).step(0.1));
  EXPECT_GT(limit.best(0.1).density, 0.0);
}

TEST(Limit, TellsOfEveryRoundAndOfTheLeastOfAll) {
  Limit limit(shaken_lattice(12), Mode::corrected, 2.2, 0.2, 1);
  for (int n = 0; n < 3; ++n) limit.round();
  const std::vector<double> half(3, 0.5), steps = limit.steps(0.5, half), cpu = limit.steps_cpu(0.5, half);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(cpu.size(), 3u);
  for (const double s : steps) EXPECT_GE(s, limit.best(0.5).step(0.5));
}

TEST(Limit, CountsInEachRoundAsManySearchesAsTheSolverMadeListsInIt) {
  Limit limit(shaken_lattice(12), Mode::paper, 2.2, 0.2, 1);
  for (int n = 0; n < 2; ++n) limit.round();
  const std::vector<double> none{0.0, 0.0}, second{0.0, 0.5};
  EXPECT_EQ(limit.steps(0.5, second)[0], limit.steps(0.5, none)[0]);
  EXPECT_GT(limit.steps(0.5, second)[1], limit.steps(0.5, none)[1]);
}

TEST(Spread, HasTheMeanOfTheTwoInTheMiddleAsMedian) {
  EXPECT_EQ(spread_of({4.0, 1.0, 2.0, 9.0}).median, 3.0);
  EXPECT_EQ(spread_of({4.0, 1.0, 9.0}).median, 4.0);
}

}  // namespace
}  // namespace tripoint::bench
