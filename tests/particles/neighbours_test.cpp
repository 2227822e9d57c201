// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "core/errors.hpp"

namespace tripoint {
namespace {

using Found = std::tuple<int, int, double, double, double>;  ///< id of i, id of j, r_j - r_i

Particles cloud(std::size_t count, const Vec3& size, bool periodic, unsigned seed = 1) {
  Particles p(count, common_fields(periodic));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto x = positions(p);
  for (std::size_t i = 0; i < count; ++i)
    x.set(i, {size.x * uniform(random), size.y * uniform(random), size.z * uniform(random)});
  return p;
}

std::vector<Found> listed(const Particles& p, const Neighbours& n, double support) {
  std::vector<Found> pairs;
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (const Entry e : n.of(i)) {
      const Vec3 d = (x.at(e.row()) - x.at(i)) + n.shift(e.image());
      if (norm(d) < support) pairs.emplace_back(p[field::id][i], p[field::id][e.row()], d.x, d.y, d.z);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::uint32_t> entries_of(const Neighbours& n, std::size_t row) {
  std::vector<std::uint32_t> list;
  for (const Entry e : n.of(row)) list.push_back(e.bits);
  return list;
}

/// Every pair and every image within one box width, tried one by one.
std::vector<Found> brute(const Particles& p, double support, const PeriodicBox& box) {
  std::vector<Found> pairs;
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < p.size(); ++j) {
      for (int k = 0; k < 27; ++k) {
        const int n[] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        Vec3 shift;
        bool there = true;
        for (std::size_t a = 0; a < 3; ++a) {
          there = there && (n[a] == 0 || box.periodic[a]);
          shift[a] = box.periodic[a] ? n[a] * box.width[a] : 0.0;
        }
        const Vec3 d = (x.at(j) - x.at(i)) + shift;
        if (there && norm(d) < support && !(i == j && k == 13))
          pairs.emplace_back(p[field::id][i], p[field::id][j], d.x, d.y, d.z);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(Neighbours, AreAllPairsWithinTheSupportInAnOpenDomain) {
  Particles p = cloud(400, {1.0, 0.7, 0.4}, false);
  Neighbours n(0.15, 0.02, {}, 2);
  n.update(p, 0.0);
  const auto pairs = listed(p, n, 0.15);
  EXPECT_GT(pairs.size(), 1000u);
  EXPECT_EQ(pairs, brute(p, 0.15, {}));
}

struct Widths : testing::TestWithParam<double> {};
TEST_P(Widths, CountEveryPeriodicImageOnce) {
  const double width = GetParam();
  const PeriodicBox box{{true, false, true}, {0.0, 0.0, 0.0}, {width, 0.0, 1.0}};
  Particles p = cloud(200, {width, 0.5, 1.0}, true);
  Neighbours n(0.26, 0.0, box, 2);
  n.update(p, 0.0);
  EXPECT_EQ(listed(p, n, 0.26), brute(p, 0.26, box));
}
// Wide; six, two and a half, two and just one support radius wide: one particle then sees another through several images, and
// itself.
INSTANTIATE_TEST_SUITE_P(Neighbours, Widths, testing::Values(1.6, 0.65, 0.52, 0.3, 0.2601));

TEST(Neighbours, RefuseAPeriodicDirectionNarrowerThanTheSupport) {
  const PeriodicBox box{{false, true, false}, {}, {0.0, 0.25, 0.0}};
  try {
    Neighbours n(0.26, 0.0, box, 1);
    FAIL() << "images would be missed";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("periodic direction y"), std::string::npos) << e.what();
  }
}

TEST(Neighbours, AreOrderedByCellAndIdWhateverTheRowsWereBefore) {
  const auto order_of = [](unsigned shuffles) {
    Particles p = cloud(300, {1.0, 1.0, 1.0}, false);
    std::vector<std::uint32_t> order(p.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::mt19937 random(shuffles);
    if (shuffles) std::shuffle(order.begin(), order.end(), random);
    p.permute(order);
    Neighbours n(0.2, 0.02, {}, 1);
    n.update(p, 0.0);
    std::vector<int> ids(p[field::id].begin(), p[field::id].end());
    for (std::size_t i = 0; i < p.size(); ++i) {
      for (const Entry e : n.of(i)) ids.push_back(p[field::id][e.row()]);
    }
    return ids;
  };
  EXPECT_EQ(order_of(0), order_of(7));
  EXPECT_EQ(order_of(0), order_of(8));
}

TEST(Neighbours, DoNotDependOnTheNumberOfThreads) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (const int threads : {1, 2, 3, 7}) {
    Particles p = cloud(500, {1.0, 1.0, 1.0}, false);
    Neighbours n(0.2, 0.02, {}, threads);
    n.update(p, 0.0);
    auto& list = lists.emplace_back();
    for (std::size_t i = 0; i < p.size(); ++i) {
      for (const Entry e : n.of(i)) list.push_back(e.bits);
    }
  }
  for (const auto& list : lists) EXPECT_EQ(list, lists.front());
}

TEST(Neighbours, OfARowAreTheSameInTheSameOrderWhateverTheWidthOfTheClusters) {
  const PeriodicBox box{{true, false, true}, {0.0, 0.0, 0.0}, {0.6, 0.0, 1.0}};
  Particles oracle_particles = cloud(700, {0.6, 0.5, 1.0}, true), p = oracle_particles;
  Neighbours oracle(0.2, 0.02, box, 1, 1);
  oracle.update(oracle_particles, 0.0);
  for (const int lanes : {2, 4, 8}) {
    Neighbours n(0.2, 0.02, box, 2, lanes);
    n.update(p, 0.0);
    EXPECT_EQ(n.entries(), oracle.entries());
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_EQ(entries_of(n, i), entries_of(oracle, i)) << lanes << " lanes, row " << i;
  }
}

TEST(Neighbours, LastUntilAParticleHasMovedByHalfTheSkin) {
  Particles p = cloud(100, {1.0, 1.0, 1.0}, false);
  Neighbours n(0.3, 0.1, {}, 1);
  EXPECT_TRUE(n.update(p, 0.0));
  p[field::position_x][7] += 0.049;
  EXPECT_FALSE(n.update(p, 0.0));
  p[field::position_x][7] += 0.002;
  EXPECT_TRUE(n.update(p, 0.0));
  EXPECT_EQ(n.rebuilds(), 2);
}

TEST(Neighbours, WithoutMotionAreNeverBuiltAgainEvenWithoutASkin) {
  Particles p = cloud(100, {1.0, 1.0, 1.0}, false);
  Neighbours n(0.3, 0.0, {}, 1);
  for (int step = 0; step < 5; ++step) n.update(p, 0.0);
  EXPECT_EQ(n.rebuilds(), 1);
}

TEST(Neighbours, PutParticlesBackIntoThePeriodicBoxAndCountHowOften) {
  const PeriodicBox box{{true, false, false}, {-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  Particles p = cloud(50, {0.4, 1.0, 1.0}, true);
  const double before = p[field::position_x][3];
  p[field::position_x][3] += 2.0;
  Neighbours n(0.3, 0.0, box, 1);
  n.update(p, 0.0);
  const std::size_t row = p.row(3);
  EXPECT_NEAR(p[field::position_x][row], before, 1e-15);
  EXPECT_EQ(p[field::image_x][row], 2);
}

TEST(Neighbours, ContinueTheSameListFromTheirBuildPositions) {
  Particles p = cloud(200, {1.0, 1.0, 1.0}, false);
  Neighbours n(0.2, 0.05, {}, 1);
  n.update(p, 0.0);
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i) x.x[i] += 0.02 * std::sin(static_cast<double>(i));
  Particles q = p;
  const std::vector<Vec3> built(n.build_positions().begin(), n.build_positions().end());
  Neighbours again(0.2, 0.05, {}, 1);
  again.rebuild_from(q, built, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(q[field::id][i], p[field::id][i]);
    ASSERT_EQ(q[field::position_x][i], p[field::position_x][i]);
    ASSERT_EQ(entries_of(again, i), entries_of(n, i));
  }
}

TEST(Neighbours, OfAParticleFarAwayDoNotAskForAMountainOfCells) {
  Particles p = cloud(100, {1.0, 1.0, 1.0}, false);
  p[field::position_x][9] = 1e9;
  Neighbours n(0.2, 0.0, {}, 1);
  n.update(p, 0.0);
  EXPECT_EQ(listed(p, n, 0.2), brute(p, 0.2, {}));
}

TEST(Neighbours, OfAParticleThatIsNowhereNameIt) {
  Particles p = cloud(10, {1.0, 1.0, 1.0}, false);
  p[field::position_y][4] = std::nan("");
  Neighbours n(0.2, 0.0, {}, 1);
  try {
    n.update(p, 2.5);
    FAIL();
  } catch (const Diverged& e) {
    EXPECT_EQ(e.particle, 4);
    EXPECT_EQ(e.field, "position");
    EXPECT_EQ(e.time, 2.5);
  }
}

}  // namespace
}  // namespace tripoint
