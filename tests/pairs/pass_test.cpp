// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/pass.hpp"
#include "effects/heat/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "pairs/run_pass.hpp"

namespace tripoint {
namespace {

/// Two terms that share a target, so that the order of adding shows.
struct First {
  static constexpr std::string_view name = "First";
  using reads = Keys<field::mass>;
  using adds = Keys<field::heat_rate>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    sum(field::heat_rate) += (j(field::mass) - i(field::mass)) * g.gradient;
  }
};
struct Second {
  static constexpr std::string_view name = "Second";
  using reads = Keys<field::temperature>;
  using adds = Keys<field::heat_rate, field::density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    sum(field::heat_rate) += (j(field::temperature) - i(field::temperature)) * g.r;
    sum(field::density) += g.kernels.poly6.value_of_square_inside(g.r2);
  }
};

/// The forms that are summed: none, one or both.
enum class Of { none, first, second, both };

template <int L>
PassFunction function_of(Of of) {
  constexpr PassFunction table[] = {pass_of<L, Any, false>(Terms<>{}), pass_of<L, Any, false>(Terms<First>{}),
                                    pass_of<L, Any, false>(Terms<Second>{}),
                                    pass_of<L, Any, false>(Terms<First, Second>{})};
  return table[static_cast<std::size_t>(of)];
}

PassFunction of(int lanes, Of terms) {
  switch (lanes) {
    case 2:
      return function_of<2>(terms);
    case 4:
      return function_of<4>(terms);
    case 8:
      return function_of<8>(terms);
    default:
      return function_of<1>(terms);
  }
}

struct PassTest : testing::Test {
  Particles particles;
  Neighbours neighbours{0.25, 0.05, {}, 1};
  PairKernels kernels{0.25};

  PassTest() {
    auto fields = common_fields(false);
    for (const auto& f : {field::temperature, field::heat_rate, field::density}) fields.emplace_back(f);
    particles = Particles(600, fields);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      positions(particles).set(i, {uniform(random), uniform(random), uniform(random)});
      particles[field::mass][i] = 1.0 + uniform(random);
      particles[field::temperature][i] = 300.0 + uniform(random);
    }
    neighbours.update(particles, 0.0);
  }
  void clear() {
    std::ranges::fill(particles[field::heat_rate], 0.0);
    std::ranges::fill(particles[field::density], 0.0);
  }
  std::vector<double> run(Of terms, int threads) {
    clear();
    run_pass(of(neighbours.clusters().lanes, terms), particles, neighbours, kernels, threads);
    return sums();
  }
  std::vector<double> sums() const {
    std::vector<double> both(particles[field::heat_rate].begin(), particles[field::heat_rate].end());
    both.insert(both.end(), particles[field::density].begin(), particles[field::density].end());
    return both;
  }
};

TEST_F(PassTest, GivesTheSameBitsFusedAndOneTermAfterTheOther) {
  const auto fused = run(Of::both, 1);
  clear();
  run_pass(of(1, Of::first), particles, neighbours, kernels, 1);
  run_pass(of(1, Of::second), particles, neighbours, kernels, 1);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    ASSERT_EQ(particles[field::heat_rate][i], fused[i]);
    ASSERT_EQ(particles[field::density][i], fused[particles.size() + i]);
  }
}

TEST_F(PassTest, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto one = run(Of::both, 1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(run(Of::both, threads), one) << threads << " threads";
}

TEST_F(PassTest, GivesTheSameBitsInVectorsOfAnyWidth) {
  const auto oracle = run(Of::both, 1);
  const PeriodicBox box{};
  for (const int lanes : {2, 4, 8}) {
    neighbours = Neighbours(0.25, 0.05, box, 2, lanes);
    neighbours.update(particles, 0.0);
    EXPECT_EQ(run(Of::both, 2), oracle) << lanes << " lanes";
  }
}

TEST_F(PassTest, ForSomeRowsLeavesTheOthersAsTheyWere) {
  const auto all = run(Of::both, 1);
  for (const int lanes : {1, 4, 8}) {
    neighbours = Neighbours(0.25, 0.05, {}, 2, lanes);
    neighbours.update(particles, 0.0);
    clear();
    const std::vector<std::uint32_t> rows{3, 4, 17, 250, 599};
    run_pass_over(of(lanes, Of::both), particles, neighbours, kernels, 2,
                  clusters_of(neighbours.clusters(), rows));
    const auto some = sums();
    for (std::uint32_t i = 0; i < 600; ++i)
      EXPECT_EQ(some[i], std::ranges::count(rows, i) ? all[i] : 0.0) << lanes << " lanes, row " << i;
  }
}

TEST_F(PassTest, OfNoTermIsNoFunction) {
  for (const double sum : run(Of::none, 1)) EXPECT_EQ(sum, 0.0);
  EXPECT_EQ(of(1, Of::none).run, nullptr);
}

TEST_F(PassTest, IsTheSumOverAllPairsTriedOneByOne) {
  const auto fused = run(Of::both, 2);
  const auto x = positions(particles);
  for (std::size_t i = 0; i < particles.size(); i += 37) {
    double heat = 0.0, density = 0.0;
    for (std::size_t j = 0; j < particles.size(); ++j) {
      const double r = norm(x.at(j) - x.at(i));
      if (j == i || r >= 0.25) continue;
      heat +=
          (particles[field::mass][j] - particles[field::mass][i]) * kernels.wendland.derivative_over_r(r) +
          (particles[field::temperature][j] - particles[field::temperature][i]) * r;
      density += kernels.poly6.value(r);
    }
    // Another order of summation, sums of 40 terms of either sign
    EXPECT_NEAR(fused[i], heat, 1e-9 * (1.0 + std::abs(heat)));
    EXPECT_NEAR(fused[particles.size() + i], density, 1e-12 * density);
  }
}

TEST_F(PassTest, NamesTheFieldThatATermReadsAndNobodyOwns) {
  Particles bare(4, common_fields(false));
  Neighbours n(0.25, 0.0, {}, 1);
  n.update(bare, 0.0);
  EXPECT_THROW(run_pass(of(1, Of::second), bare, n, kernels, 1), MissingField);
}

}  // namespace
}  // namespace tripoint
