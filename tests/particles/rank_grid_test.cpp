// SPDX-License-Identifier: BSD-3-Clause
#include "particles/rank_grid.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace tripoint {
namespace {

/// Particles on a lattice of spacing 1, box after box.
struct Boxes {
  std::vector<Vec3> places;
  std::vector<char> idle;
  void add(const Vec3& from, const Vec3& to, bool is_idle) {
    for (double z = from.z; z < to.z; ++z)
      for (double y = from.y; y < to.y; ++y)
        for (double x = from.x; x < to.x; ++x) {
          places.push_back({x + 0.5, y + 0.5, z + 0.5});
          idle.push_back(is_idle ? 1 : 0);
        }
  }
  [[nodiscard]] ToShareOut what() const { return {places, idle, 1.0, 2.5, {}, {}, {}}; }
};

/// The box is longest along the run. A cut across it would go through the column, or leave one rank nearly
/// all walls; one across the height halves the work of pairs and not the rows.
TEST(RankGrid, ADamIsCutAlongItsRun) {
  Boxes dam;
  dam.add({0, 0, -3}, {64, 24, 0}, true);
  dam.add({0, 0, 0}, {10, 24, 20}, false);
  EXPECT_EQ(rank_grid(2, dam.what()), (std::array<int, 3>{1, 2, 1}));
}

TEST(RankGrid, TheSmallestFaceIsCutWhereAllCostAsMuch) {
  Boxes slab;
  slab.add({0, 0, 0}, {8, 10, 24}, false);
  EXPECT_EQ(rank_grid(1, slab.what()), (std::array<int, 3>{1, 1, 1}));
  EXPECT_EQ(rank_grid(2, slab.what()), (std::array<int, 3>{1, 1, 2}));
  Boxes cube;
  cube.add({0, 0, 0}, {24, 24, 24}, false);
  EXPECT_EQ(rank_grid(8, cube.what()), (std::array<int, 3>{2, 2, 2}));
}

/// A line that leaves a block by its corner: halves along two directions would each be even, and one of the
/// quarters would have the line.
TEST(RankGrid, WhatIsEvenInEachDirectionNeedNotBeEven) {
  Boxes block;
  block.add({0, 0, 0}, {16, 8, 8}, false);
  block.add({16, 0, 0}, {64, 1, 1}, false);
  const ToShareOut what = block.what();
  const Cuts cuts = cuts_of(what, rank_grid(4, what));
  std::vector<double> own(4, 0.0);
  for (const Vec3& r : what.places) own[cuts.rank_of(r)] += 1.0;
  for (const double one : own) EXPECT_NEAR(one / 268.0, 1.0, 0.2);
}

/// Particles that cost a fifth: the plane lies where the costs are even, not the numbers.
TEST(RankGrid, PlanesPartTheCost) {
  Boxes line;
  line.add({0, 0, 0}, {100, 1, 1}, true);
  line.add({100, 0, 0}, {200, 1, 1}, false);
  const Cuts cuts = cuts_of(line.what(), {2, 1, 1});
  const double all = 100.0 * (ParticleCost::at_start(true) + ParticleCost::at_start(false));
  EXPECT_NEAR(cuts.at[0][1], 200.0 - 0.5 * all / ParticleCost::at_start(false), 2.0);
}

}  // namespace
}  // namespace tripoint
