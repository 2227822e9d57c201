// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
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
// Wide; six, two and a half, two and just one support radius wide: one particle then sees another through
// several images, and itself.
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
    for (std::size_t i = 0; i < p.size(); ++i)
      ASSERT_EQ(entries_of(n, i), entries_of(oracle, i)) << lanes << " lanes, row " << i;
  }
}

TEST(Neighbours, LastUntilAParticleHasMovedByHalfTheSkin) {
  Particles p = cloud(100, {1.0, 1.0, 1.0}, false);
  Neighbours n(0.3, 0.1, {}, 1);
  EXPECT_TRUE(n.update(p, 0.0));
  p[field::position.x][7] += 0.049;
  EXPECT_FALSE(n.update(p, 0.0));
  p[field::position.x][7] += 0.002;
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
  const double before = p[field::position.x][3];
  p[field::position.x][3] += 2.0;
  Neighbours n(0.3, 0.0, box, 1);
  n.update(p, 0.0);
  const std::size_t row = p.row(3);
  EXPECT_NEAR(p[field::position.x][row], before, 1e-15);
  EXPECT_EQ(p[field::image.x][row], 2);
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
    ASSERT_EQ(q[field::position.x][i], p[field::position.x][i]);
    ASSERT_EQ(entries_of(again, i), entries_of(n, i));
  }
}

/// Lists of rows that are asked for, in no order, without excluded pairs and with.
TEST(Neighbours, ThatAreMadeWhereSomebodyAsksAreTheSame) {
  const PeriodicBox box{{true, false, false}, {}, {4.0, 3.0, 3.0}};
  Particles p = cloud(600, {4.0, 3.0, 3.0}, true);
  Neighbours all(0.7, 0.1, box, 1, 4);
  all.update(p, 0.0);
  ExcludedPairs own;
  const auto id = p[field::id];
  for (std::size_t row = 0; row < p.size(); row += 3)
    for (const Entry e : all.of(row))
      if (e.row() % 2 == 0)
        make_own(own, static_cast<std::uint32_t>(id[row]), static_cast<std::uint32_t>(id[e.row()]), 1.0);
  Particles same = p;
  Neighbours asked = all.anew(box);
  asked.list_when_asked();
  asked.rebuild_from(same, all.build_positions(), 0.0);
  EXPECT_EQ(asked.entries(), 0u) << "none was asked for";
  for (const ExcludedPairs& pairs : {ExcludedPairs{}, own}) {
    all.mark_own(p, pairs);
    asked.mark_own(same, pairs);
    for (const std::size_t row : {7u, 599u, 0u, 6u, 7u, 301u, 2u, 100u, 101u, 102u, 103u}) {
      SCOPED_TRACE("row " + std::to_string(row));
      EXPECT_EQ(id[row], same[field::id][row]);
      EXPECT_FALSE(entries_of(all, row).empty());
      EXPECT_EQ(entries_of(asked, row), entries_of(all, row));
    }
  }
  EXPECT_TRUE(
      std::ranges::any_of(entries_of(asked, 0), [](std::uint32_t bits) { return Entry{bits}.own(); }));
}

TEST(Neighbours, OfAParticleFarAwayDoNotAskForAMountainOfCells) {
  Particles p = cloud(100, {1.0, 1.0, 1.0}, false);
  p[field::position.x][9] = 1e9;
  Neighbours n(0.2, 0.0, {}, 1);
  n.update(p, 0.0);
  EXPECT_EQ(listed(p, n, 0.2), brute(p, 0.2, {}));
}

TEST(Neighbours, OfAParticleThatIsNowhereNameIt) {
  Particles p = cloud(10, {1.0, 1.0, 1.0}, false);
  p[field::position.y][4] = std::nan("");
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

TEST(Neighbours, OfManyAreVisitedStripByStrip) {
  // Of a strip: 6 cells of 1/1.5 of the reach
  constexpr double support = 0.05, skin = 0.005, wide = 4.0 * (support + skin);
  Particles few = cloud(9'000, {1.0, 1.0, 1.0}, false), many = cloud(12'000, {1.0, 1.0, 1.0}, false);
  Neighbours n(support, skin, {}, 1);
  n.update(few, 0.0);
  EXPECT_TRUE(n.clusters().visits.empty());
  Neighbours m(support, skin, {}, 1);
  m.update(many, 0.0);
  const Clusters& c = m.clusters();
  const auto y = many[field::position.y];
  const double low = *std::ranges::min_element(y);
  std::vector<std::pair<int, std::uint32_t>> visited;
  c.each([&](std::uint32_t k) { visited.emplace_back(static_cast<int>((y[c.first[k]] - low) / wide), k); });
  EXPECT_GT(visited.back().first, 3);
  EXPECT_TRUE(std::ranges::is_sorted(visited));
  std::vector<std::uint32_t> all(c.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_TRUE(std::ranges::is_permutation(c.visits, all));
}

/// A long fixed bar, body 0, and a few particles that move along above it.
Particles bar_with_movers() {
  constexpr int along = 120, across = 5;
  constexpr std::size_t fixed = along * across * across, movers = 12;
  Particles p(fixed + movers, common_fields(false));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> noise(-0.01, 0.01);
  const auto x = positions(p);
  std::ranges::fill(p[field::body], -1);
  for (std::size_t i = 0; i < fixed; ++i) {
    const auto n = static_cast<int>(i);
    x.set(i, Vec3{0.1 * (n % along), 0.1 * (n / along % across), 0.1 * (n / along / across)} +
                 Vec3{noise(random), noise(random), noise(random)});
    p[field::body][i] = 0;
  }
  for (std::size_t i = fixed; i < p.size(); ++i)
    x.set(i, {0.3 + 0.1 * static_cast<double>(i - fixed), 0.2 + noise(random), 0.55});
  return p;
}

/// Ids of rows, and of what each is listed with, in the order of the list.
std::vector<int> listed_ids(const Particles& p, const Neighbours& n, std::size_t row) {
  std::vector<int> ids;
  for (const Entry e : n.of(row)) ids.push_back(p[field::id][e.row()]);
  return ids;
}

TEST(Neighbours, WhatSleepsChangesNoListNoCountAndNoOrder) {
  for (const int lanes : {1, 4, 8}) {
    Particles some = bar_with_movers(), all = some;
    Neighbours sleepy(0.25, 0.05, {}, 2, lanes), whole(0.25, 0.05, {}, 1, lanes);
    for (int round = 0; round < 8; ++round) {
      for (Particles* p : {&some, &all})
        for (std::size_t i = 0; i < p->size(); ++i)
          if ((*p)[field::body][i] < 0) {
            // To the side and up: there are more cells
            const bool leaves = (*p)[field::id][i] + 1 == static_cast<int>(p->size());
            // Far at once: what slept wakes, and what woke sleeps
            positions(*p).x[i] += round < 5 ? 0.9 : -1.4;
            if (leaves && round > 2) {
              positions(*p).y[i] += 0.4;
              positions(*p).z[i] += 0.4;
            }
          }
      ASSERT_TRUE(sleepy.update(some, 0.0, [] { return Resting{{1}, 0.5}; }));
      whole.update(all, 0.0);
      EXPECT_EQ(sleepy.entries(), whole.entries()) << "round " << round;
      EXPECT_EQ(some.awake() < some.size(), round >= 2)
          << "the first lists are of all, and so are those in which fixed particles are found";
      const std::vector<std::uint32_t> order = sleepy.rows_in_order(some);
      ASSERT_EQ(order.size(), all.size());
      for (std::size_t n = 0; n < order.size(); ++n) ASSERT_EQ(some[field::id][order[n]], all[field::id][n]);
      const Clusters& c = sleepy.clusters();
      std::vector<char> has_list(some.awake(), 0);
      for (const std::uint32_t k : c.listed)
        std::fill(has_list.begin() + c.first[k], has_list.begin() + c.first[k + 1], char{1});
      for (std::size_t n = 0; n < order.size(); ++n) {
        const std::size_t row = order[n];
        const std::vector<int> ids = listed_ids(all, whole, n);
        const bool meets_mover = std::ranges::any_of(
            ids, [&](int id) { return all[field::body][all.row(static_cast<std::size_t>(id))] < 0; });
        const bool listed = row < some.awake() && has_list[row] != 0;
        EXPECT_TRUE(listed || (all[field::body][n] >= 0 && !meets_mover))
            << "round " << round << ", id " << all[field::id][n];
        EXPECT_TRUE(!listed || listed_ids(some, sleepy, row) == ids)
            << "round " << round << ", id " << all[field::id][n];
      }
    }
    EXPECT_LT(some.awake(), some.size() / 3);
    EXPECT_EQ(whole.whole_lists(), 8);
    EXPECT_EQ(sleepy.whole_lists(), 2);
  }
}

/// Rows are sorted anew from any order: those that move are thrown about a small place between two lists.
TEST(Neighbours, OfACrowdThatIsThrownAboutKeepTheOrder) {
  constexpr std::size_t crowd = 300;
  const Particles bar = bar_with_movers();
  Particles some(bar.size() + crowd, common_fields(false));
  std::ranges::fill(some[field::body], -1);
  std::ranges::copy(bar[field::body], some[field::body].begin());
  for (std::size_t i = 0; i < bar.size(); ++i) positions(some).set(i, bar.position(i));
  Particles all = some;
  Neighbours sleepy(0.25, 0.05, {}, 1, 4), whole(0.25, 0.05, {}, 1, 4);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 0.5);
  for (int round = 0; round < 5; ++round) {
    for (std::size_t id = bar.size(); id < all.size(); ++id) {
      const Vec3 r{0.5 * uniform(random), 0.5 * uniform(random), 0.45 + 0.5 * uniform(random)};
      for (Particles* p : {&some, &all}) positions(*p).set(p->row(id), r);
    }
    ASSERT_TRUE(sleepy.update(some, 0.0, [] { return Resting{{1}}; }));
    whole.update(all, 0.0);
    const std::vector<std::uint32_t> order = sleepy.rows_in_order(some);
    for (std::size_t n = 0; n < order.size(); ++n) {
      ASSERT_EQ(some[field::id][order[n]], all[field::id][n]) << "round " << round;
      if (order[n] < some.moving()) {
        ASSERT_EQ(listed_ids(some, sleepy, order[n]), listed_ids(all, whole, n)) << "round " << round;
      }
    }
  }
  EXPECT_EQ(some.moving(), crowd + 12);
}

TEST(Neighbours, BlocksOfRowsAreThoseOfAllRows) {
  Particles p = bar_with_movers();
  Neighbours n(0.25, 0.05, {}, 1, 8);
  for (int round = 0; round < 4; ++round) {
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p[field::body][i] < 0) positions(p).x[i] += 1.7;
    n.update(p, 0.0, [] { return Resting{{1}, 0.3}; });
  }
  ASSERT_EQ(p.moving(), 12u);
  ASSERT_LT(p.awake(), p.size());
  const std::vector<std::uint32_t> order = n.rows_in_order(p);
  const auto first = n.row_blocks();
  ASSERT_EQ(first.size(), (p.size() + 1023) / 1024 + 1);
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    std::vector<std::uint32_t> moving;
    for (std::size_t k = 1024 * b; k < std::min(order.size(), 1024 * (b + 1)); ++k)
      if (order[k] < p.moving()) moving.push_back(order[k]);
    std::vector<std::uint32_t> block(first[b + 1] - first[b]);
    std::iota(block.begin(), block.end(), first[b]);
    EXPECT_EQ(block, moving) << "block " << b;
  }
}

/// A part with other ids has in the list of each particle of its own what the whole has there, in the same
/// order.
TEST(Neighbours, OfAPartHaveTheOrderOfTheWhole) {
  constexpr double support = 0.15, skin = 0.02, border = 0.37;
  Particles whole = cloud(600, {1.0, 0.7, 0.4}, false);
  Neighbours all(support, skin, {}, 1, 4);
  all.update(whole, 0.0);
  Whole known{whole.position(0), whole.position(0), whole.size(), {}, 0};
  std::vector<std::size_t> number, ghosts;  // of each id of the part, descending; its own come first
  for (std::size_t id = whole.size(); id-- > 0;) {
    const Vec3 r = whole.position(whole.row(id));
    for (std::size_t a = 0; a < 3; ++a) {
      known.low[a] = std::min(known.low[a], r[a]);
      known.high[a] = std::max(known.high[a], r[a]);
    }
    if (r.x > border - support - skin) (r.x > border ? number : ghosts).push_back(id);
  }
  known.own = number.size();
  number.insert(number.end(), ghosts.begin(), ghosts.end());
  Particles part(number.size(), common_fields(false));
  for (std::size_t id = 0; id < number.size(); ++id)
    positions(part).set(id, whole.position(whole.row(number[id])));
  known.numbers.assign(number.begin(), number.end());
  Neighbours some(support, skin, {}, 1, 4);
  some.drop_lists(known);
  some.update(part, 0.0);
  std::size_t pairs = 0;
  for (std::size_t id = 0; id < number.size(); ++id) {
    std::vector<std::size_t> here, there;
    for (const Entry e : some.of(part.row(id)))
      here.push_back(number[static_cast<std::size_t>(part[field::id][e.row()])]);
    if (id < known.own)
      for (const Entry e : all.of(whole.row(number[id])))
        there.push_back(static_cast<std::size_t>(whole[field::id][e.row()]));
    EXPECT_EQ(here, there) << "of particle " << number[id];  // a copy has no list
    EXPECT_EQ(part.row(id) < known.own, id < known.own);
    pairs += here.size();
  }
  EXPECT_EQ(some.entries(), pairs);
  EXPECT_GT(known.own, 300u);
  EXPECT_LT(part.size(), whole.size());
}

}  // namespace
}  // namespace tripoint
