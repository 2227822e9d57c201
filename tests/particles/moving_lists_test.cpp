// SPDX-License-Identifier: BSD-3-Clause
// Lists of partners on their way from one process to another.
#include "particles/moving_lists.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace tripoint {
namespace {

/// A chain 0 - 1 - 2 - 3 with bonds of length 1 and excluded pairs, all numbers of a bond different.
struct Chain {
  Chain() {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double n = i;
      connect(bonds, i, i + 1, {0, 0, {-1.0, n, 0.5}, {2.0, n, 0.25}, 3.0 + n},
              {0, 0, {1.0, -n, -0.5}, {-2.0, n, 0.125}, 3.0 + n});
      make_own(own, i, i + 1, 7.0 + n);
    }
    for (std::size_t id = 0; id < 4; ++id) numbers.push_back(lists_as_numbers(bonds, own, id));
  }
  /// What a process has that holds these particles. @param owned of the first of them
  [[nodiscard]] Share share(std::size_t owned, const std::vector<int>& number) const {
    return {owned, number, [this, number](std::size_t id) {
              return std::span<const double>(numbers[static_cast<std::size_t>(number[id])]);
            }};
  }
  Bonds bonds;
  ExcludedPairs own;
  std::vector<std::vector<double>> numbers;
};

TEST(MovingLists, ArriveWithAllThatABondHas) {
  const Chain chain;
  Bonds bonds;
  ExcludedPairs own;
  take_lists(chain.share(2, {2, 1, 0, 3}), bonds, own);  // 2 and 1 are its own, 0 and 3 are ghosts
  ASSERT_EQ(bonds.of(0).size(), 2u);
  ASSERT_EQ(bonds.of(1).size(), 2u);
  for (const auto& [id, number] : {std::pair{0u, 2u}, {1u, 1u}}) {
    for (std::size_t n = 0; n < 2; ++n) {
      const Bond &here = bonds.of(id)[n], &there = chain.bonds.of(number)[n];
      EXPECT_EQ(here.x, there.x);
      EXPECT_EQ(here.gradient, there.gradient);
      EXPECT_EQ(here.weight, there.weight);
      EXPECT_EQ(here.other, (std::vector<std::uint32_t>{2, 1, 0, 3}[there.other]));
      const Bond& twin = bonds.of(here.other)[here.twin];
      EXPECT_EQ(twin.other, id);
      EXPECT_EQ(twin.gradient, chain.bonds.of(there.other)[there.twin].gradient);
    }
  }
  EXPECT_TRUE(are_own(own, 0, 1));
  EXPECT_TRUE(are_own(own, 0, 3));
  EXPECT_FALSE(are_own(own, 0, 2));
}

TEST(MovingLists, OfACopyAreThoseWithItsOwn) {
  const Chain chain;
  Bonds bonds;
  ExcludedPairs own;
  take_lists(chain.share(1, {0, 1, 2}), bonds, own);
  ASSERT_EQ(bonds.of(1).size(), 1u) << "1 with 0; what it has with 2 is formed elsewhere";
  EXPECT_EQ(bonds.of(1)[0].other, 0u);
  EXPECT_TRUE(bonds.of(2).empty());
}

TEST(MovingLists, RefuseByNumberAPartnerThatIsNotThere) {
  const Chain chain;
  Bonds bonds;
  ExcludedPairs own;
  try {
    take_lists(chain.share(2, {1, 2, 3}), bonds, own);
    FAIL() << "1 has a bond with 0, which is not there";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("particle 1 of the scene has a bond with particle 0"),
              std::string::npos)
        << e.what();
  }
}

/// Excluded pairs meet at every image; bonds are with one of them.
TEST(MovingLists, KnowImagesOfOneParticle) {
  const Chain chain;
  Bonds bonds;
  ExcludedPairs own;
  take_lists(chain.share(1, {0, 1, 1}), bonds, own);
  EXPECT_EQ(bonds.of(0)[0].other, 1u);
  EXPECT_TRUE(bonds.of(2).empty());
  EXPECT_TRUE(are_own(own, 0, 1) && are_own(own, 0, 2));
}

TEST(MovingLists, CountTheNumbersOfTheLongest) {
  const Chain chain;
  EXPECT_EQ(most_list_numbers(chain.bonds, chain.own), chain.numbers[1].size());
  EXPECT_EQ(most_list_numbers({}, {}), 0u);
}

}  // namespace
}  // namespace tripoint
