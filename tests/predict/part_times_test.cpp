// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "program/predict/part_times.hpp"

namespace tripoint::predict {
namespace {

/// One step of two parts.
PartTimes step(double work, double call, double more_work, double more_call) {
  return {{work, more_work}, {call, more_call}, {work + call, more_work + more_call}, 1};
}

TEST(PartTimes, OfTwoRanksAreTheShortestOfTheFirst) {
  BestTimes best;
  best.add({step(3, 1, 5, 0.5), step(4, 0, 5, 0.5)});
  EXPECT_EQ(best.wall(), 9.5);
  best.add({step(3, 2, 4, 0.25), step(5, 0, 4, 0.25)});
  EXPECT_EQ(best.wall(), 4 + 4.25);
  EXPECT_EQ(best.cpu(), 4 + 4.25);
}

/// Each run has one slow core, and another one: the shortest of whole parts is never fast, each core by
/// itself is.
TEST(PartTimes, UndisturbedIsEachRankAtItsBest) {
  BestTimes best;
  best.add({step(2, 2.1, 2, 2.1), step(4, 0.1, 4, 0.1)});
  best.add({step(4, 0.1, 4, 0.1), step(2, 2.1, 2, 2.1)});
  EXPECT_EQ(best.wall(), 8.2);
  EXPECT_DOUBLE_EQ(best.undisturbed(), 2 + 0.1 + 2 + 0.1);
}

TEST(PartTimes, UndisturbedKeepsWhatIsNotEven) {
  BestTimes best;
  for (int n = 0; n < 2; ++n) best.add({step(3, 1.5, 2, 0.5), step(4, 0.5, 1, 1.5)});
  EXPECT_DOUBLE_EQ(best.undisturbed(), 4 + 0.5 + 2 + 0.5);
}

/// Each turn has one slow core: the slowest of its runs counts, and undisturbed each run is at its best.
TEST(PartTimes, OfRunsApartAreThoseOfTheSlowest) {
  BestTimes best;
  best.add_apart({step(2, 0, 4, 0), step(3, 0, 2, 0)});
  EXPECT_EQ(best.wall(), 3 + 4);
  best.add_apart({step(2.5, 0, 2, 0), step(2, 0, 3, 0)});
  EXPECT_EQ(best.wall(), 2.5 + 3);
  EXPECT_EQ(best.undisturbed(), 2 + 2);
}

TEST(PartTimes, OtherStepsAreRefused) {
  BestTimes best;
  best.add({step(1, 1, 1, 1)});
  EXPECT_THROW(best.add({PartTimes{{1.0}, {1.0}, {1.0}, 1}}), EngineError);
}

TEST(PartTimes, AreReadLineByLine) {
  const std::string path = (std::filesystem::temp_directory_path() / "tripoint-part-times.txt").string();
  std::ofstream(path) << "1 2 3 4 5 6\n0.5 0.25 0.125\n";
  const PartTimes times = read_part_times(path);
  EXPECT_EQ(times.steps, 2);
  EXPECT_EQ(times.work, (std::vector<double>{1, 4, 0.5}));
  EXPECT_EQ(times.call, (std::vector<double>{2, 5, 0.25}));
  EXPECT_EQ(times.cpu_a_step(), (3 + 6 + 0.125) / 2);
  std::ofstream(path) << "1 2 3 x\n";
  EXPECT_THROW(static_cast<void>(read_part_times(path)), EngineError);
  std::ofstream(path) << "";
  EXPECT_THROW(static_cast<void>(read_part_times(path)), EngineError);
  std::filesystem::remove(path);
  EXPECT_THROW(static_cast<void>(read_part_times(path)), EngineError);
}

TEST(Settling, NeedsThreeRepeatsThatLowerNothing) {
  Settling settling;
  EXPECT_FALSE(settling.add({10, 20}));
  EXPECT_FALSE(settling.add({10, 19.95}));  // a quarter of a per cent
  EXPECT_FALSE(settling.add({9.99, 19.95}));
  EXPECT_FALSE(settling.add({9.99, 19.7}));  // one time has fallen
  EXPECT_FALSE(settling.add({9.99, 19.7}));
  EXPECT_FALSE(settling.add({9.99, 19.7}));
  EXPECT_TRUE(settling.add({9.99, 19.7}));
  EXPECT_FALSE(settling.add({9.99, 19.7, 1}));  // a new time
}

}  // namespace
}  // namespace tripoint::predict
