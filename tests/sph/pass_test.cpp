// SPDX-License-Identifier: BSD-3-Clause
#include "sph/pass.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tripoint {
namespace {

/// Two terms that share a target, so that the order of adding shows.
struct First {
  using reads = Keys<field::mass>;
  using adds = Keys<field::heat_rate>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 1> i, std::span<const double, 1> j, std::span<V, 1> sum) {
    sum[0] += (j[0] - i[0]) * g.gradient;
  }
};
struct Second {
  using reads = Keys<field::temperature>;
  using adds = Keys<field::heat_rate, field::density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 1> i, std::span<const double, 1> j, std::span<V, 2> sum) {
    sum[0] += (j[0] - i[0]) * g.r;
    sum[1] += g.kernels.poly6.value(g.r);
  }
};
using Both = Pass<Slot<First, None>, Slot<None, Second>>;

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
  std::vector<double> run(const Both& pass, int threads) {
    std::ranges::fill(particles[field::heat_rate], 0.0);
    std::ranges::fill(particles[field::density], 0.0);
    pass(particles, neighbours, kernels, threads);
    std::vector<double> sums(particles[field::heat_rate].begin(), particles[field::heat_rate].end());
    sums.insert(sums.end(), particles[field::density].begin(), particles[field::density].end());
    return sums;
  }
};

TEST_F(PassTest, GivesTheSameBitsFusedAndOneTermAfterTheOther) {
  const auto fused = run(Both({Form::paper, Form::corrected}), 1);
  std::ranges::fill(particles[field::heat_rate], 0.0);
  std::ranges::fill(particles[field::density], 0.0);
  Both({Form::paper, Form::off})(particles, neighbours, kernels, 1);
  Both({Form::off, Form::corrected})(particles, neighbours, kernels, 1);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    ASSERT_EQ(particles[field::heat_rate][i], fused[i]);
    ASSERT_EQ(particles[field::density][i], fused[particles.size() + i]);
  }
}

TEST_F(PassTest, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Both pass({Form::paper, Form::corrected});
  const auto one = run(pass, 1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(run(pass, threads), one) << threads << " threads";
}

TEST_F(PassTest, LeavesOutWhatASlotDoesNotHave) {
  const Both none({Form::corrected, Form::paper});  // neither form exists
  for (const double sum : run(none, 1)) EXPECT_EQ(sum, 0.0);
  EXPECT_TRUE(Both({Form::off, Form::off}).idle());
}

TEST_F(PassTest, IsTheSumOverAllPairsTriedOneByOne) {
  const auto fused = run(Both({Form::paper, Form::corrected}), 2);
  const auto x = positions(particles);
  for (std::size_t i = 0; i < particles.size(); i += 37) {
    double heat = 0.0, density = 0.0;
    for (std::size_t j = 0; j < particles.size(); ++j) {
      const double r = norm(x.at(j) - x.at(i));
      if (j == i || r >= 0.25) continue;
      heat += (particles[field::mass][j] - particles[field::mass][i]) * kernels.wendland.derivative_over_r(r) +
              (particles[field::temperature][j] - particles[field::temperature][i]) * r;
      density += kernels.poly6.value(r);
    }
    EXPECT_NEAR(fused[i], heat, 1e-9 * (1.0 + std::abs(heat)));  // another order of summation, sums of 40 terms of either sign
    EXPECT_NEAR(fused[particles.size() + i], density, 1e-12 * density);
  }
}

TEST_F(PassTest, NamesTheFieldThatATermReadsAndNobodyOwns) {
  Particles bare(4, common_fields(false));
  Neighbours n(0.25, 0.0, {}, 1);
  n.update(bare, 0.0);
  EXPECT_THROW(Both({Form::off, Form::corrected})(bare, n, kernels, 1), MissingField);
}

}  // namespace
}  // namespace tripoint
