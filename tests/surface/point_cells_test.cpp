// SPDX-License-Identifier: BSD-3-Clause
#include "surface/point_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "core/errors.hpp"

namespace tripoint {
namespace {

std::vector<Vec3> scattered(std::size_t n, double width) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in(0.0, width);
  std::vector<Vec3> places(n);
  for (Vec3& r : places) r = {in(random), in(random), in(random)};
  return places;
}

TEST(PointCells, GathersEveryPointWithinReachOfAPlace) {
  const auto places = scattered(2000, 1.0);
  const PointCells cells(places, 0.06);
  NearCache cache(cells, 0.1);
  std::size_t seen = 0;
  for (const Vec3& r : scattered(300, 1.2)) {
    const NearPoints& near = cache.around(r - Vec3{0.1, 0.1, 0.1});
    std::set<std::uint32_t> gathered(near.row.begin(), near.row.end());
    EXPECT_EQ(gathered.size(), near.row.size()) << "a point came twice";
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      if (norm(places[i] - (r - Vec3{0.1, 0.1, 0.1})) >= 0.1) continue;
      ++seen;
      EXPECT_TRUE(gathered.contains(i));
    }
  }
  EXPECT_GT(seen, 1000U);
}

TEST(PointCells, GiveWholeVectorsWithRowsOfTheirOwn) {
  const auto places = scattered(500, 1.0);
  const PointCells cells(places, 0.1);
  NearPoints near;
  cells.gather(cells.cell_of({0.5, 0.5, 0.5}), 0.2, near);
  ASSERT_GT(near.row.size(), 3U);
  EXPECT_EQ(near.x.size() % 4, 0U);
  EXPECT_LT(near.x.size() - near.row.size(), 4U);
  for (std::size_t k = 0; k < near.row.size(); ++k)
    EXPECT_EQ((Vec3{near.x[k], near.y[k], near.z[k]}), places[near.row[k]]);
}

TEST(PointCells, TakeMemoryForPointsAndNotForTheRoomBetween) {
  auto places = scattered(100, 1.0);
  places.push_back({3e4, -2e4, 1e4});
  const PointCells cells(places, 0.1);
  EXPECT_LE(cells.occupied().size(), places.size());
  NearCache cache(cells, 0.1);
  EXPECT_EQ(cache.around({3e4, -2e4, 1e4}).row.size(), 1U);
  EXPECT_TRUE(cache.around({1e5, 1e5, 1e5}).empty());
}

TEST(PointCells, RefuseWhatCannotBeNumbered) {
  EXPECT_THROW(PointCells(std::vector<Vec3>{{0, 0, 0}, {1e9, 0, 0}}, 0.1), InputError);
  EXPECT_THROW(PointCells(std::vector<Vec3>{{std::numeric_limits<double>::quiet_NaN(), 0, 0}}, 0.1),
               InputError);
  EXPECT_EQ(PointCells(std::vector<Vec3>{}, 0.1).size(), 0U);
}

TEST(CellTable, HoldsEachCellOnceAndGrows) {
  CellTable table(2);
  for (std::uint32_t n = 0; n < 1000; ++n)
    EXPECT_TRUE(table.insert(CellTable::key({static_cast<int>(n), -static_cast<int>(n), 3}), n));
  EXPECT_FALSE(table.insert(CellTable::key({5, -5, 3}), 77));
  EXPECT_EQ(table.size(), 1000U);
  EXPECT_EQ(table.find(CellTable::key({5, -5, 3})), 5U);
  EXPECT_EQ(table.find(CellTable::key({5, 5, 3})), CellTable::none);
  EXPECT_EQ(CellTable::cell(CellTable::key({-7, 12, 1 << 19})), (CellIndex{-7, 12, 1 << 19}));
}

}  // namespace
}  // namespace tripoint
