// SPDX-License-Identifier: BSD-3-Clause
// The pairs that the fluid lists beside the fused passes.
#include "liquids/listed_pairs.hpp"

#include <gtest/gtest.h>

namespace tripoint {
namespace {

using liquid::ListedPairs;

/// Two rows: 4 with two pairs, 9 with one.
void list_two_rows(ListedPairs<>& pairs) {
  pairs.add({5, 13});
  pairs.add({6, 13});
  pairs.end_row(4);
  pairs.add({4, 12});
  pairs.end_row(9);
}

TEST(ListedPairs, AreThoseOfTheirRowInTheOrderOfTheLists) {
  ListedPairs<> pairs;
  ASSERT_TRUE(pairs.renew(1));
  list_two_rows(pairs);
  ASSERT_EQ(pairs.rows(), 2u);
  EXPECT_EQ(pairs.pairs(), 3u);
  EXPECT_EQ(pairs.row(0), 4u);
  EXPECT_EQ(pairs.row(1), 9u);
  ASSERT_EQ(pairs.of(0).size(), 2u);
  EXPECT_EQ(pairs.of(0)[0].row, 5u);
  EXPECT_EQ(pairs.of(0)[1].row, 6u);
  EXPECT_EQ(pairs.first(1), 2u);
  ASSERT_EQ(pairs.of(1).size(), 1u);
  EXPECT_EQ(pairs.of(1)[0].image, 12u);
}

TEST(ListedPairs, StayUntilTheNeighbourListsAreRebuilt) {
  ListedPairs<> pairs;
  ASSERT_TRUE(pairs.renew(7));
  list_two_rows(pairs);
  EXPECT_FALSE(pairs.renew(7));
  EXPECT_EQ(pairs.pairs(), 3u);
  EXPECT_TRUE(pairs.renew(8));
  EXPECT_EQ(pairs.pairs(), 0u);
  EXPECT_EQ(pairs.rows(), 0u);
}

TEST(ListedPairs, AreListedAgainWhereTheyWereCleared) {
  ListedPairs<> pairs;
  ASSERT_TRUE(pairs.renew(7));
  list_two_rows(pairs);
  pairs.clear();
  EXPECT_TRUE(pairs.renew(7));
  EXPECT_EQ(pairs.pairs(), 0u);
}

TEST(ListedPairs, KnowARowThatHasPairsAndIsNotEnded) {
  ListedPairs<> pairs;
  ASSERT_TRUE(pairs.renew(1));
  EXPECT_FALSE(pairs.has_open_row());
  pairs.add({5, 13});
  EXPECT_TRUE(pairs.has_open_row());
  pairs.end_row(4);
  EXPECT_FALSE(pairs.has_open_row());
}

TEST(ListedPairs, VisitEachListedRowOnceWhateverTheThreads) {
  ListedPairs<> pairs;
  ASSERT_TRUE(pairs.renew(1));
  list_two_rows(pairs);
  pairs.end_row(11);  // a row may be listed without pairs
  for (const int threads : {1, 3}) {
    std::vector<std::size_t> found(pairs.rows(), 99);
    pairs.each_row(threads, [&](std::size_t n) { found[n] = pairs.of(n).size(); });
    EXPECT_EQ(found, (std::vector<std::size_t>{2, 1, 0})) << threads;
  }
}

}  // namespace
}  // namespace tripoint
