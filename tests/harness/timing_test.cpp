// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/campaign/timing.hpp"
#include "validation/results/timing_pairs.hpp"

namespace tripoint {
namespace {

TEST(Timing, TheNoiseFloorIsWhatARunDiffersFromItself) {
  EXPECT_EQ(noise_floor({{1.0, 1.0}, {2.0, 2.0}, {1.5, 1.5}}), 1.0);  // it never did
  // It always did by a tenth: round-off
  EXPECT_NEAR(noise_floor({{1.1, 1.0}, {1.1, 1.0}, {1.1, 1.0}}), 1.1, 1e-12);
  // Two of +-20 %: standard error s sqrt(2)/sqrt(2)
  const double s = std::log(1.2);
  EXPECT_NEAR(noise_floor({{1.2, 1.0}, {1.0, 1.2}}), std::exp(2.0 * s), 1e-12);
  EXPECT_TRUE(std::isnan(noise_floor({{1.0, 1.0}})));  // one round says nothing
  EXPECT_TRUE(std::isnan(noise_floor({{1.0, 0.0}, {1.0, 1.0}})));
}

TEST(Timing, MedianAndItsDeviationAreNotMovedByOneRunThatWasDisturbed) {
  EXPECT_EQ(median({3.0, 1.0, 2.0, 100.0, 2.5}), 2.5);
  EXPECT_EQ(median({1.0, 2.0}), 1.5);
  EXPECT_EQ(median_deviation({1.0, 2.0, 3.0, 4.0, 1000.0}), 1.0);
}

/// Two engines with these CPU seconds at the case's own resolution.
CaseResult two(double a, double b, double floor) {
  auto r = green();
  auto other = engine(r);
  other.name = "bullet";
  engine(r).runs[0].cost.repeats = {a, a, a};
  other.runs[0].cost.repeats = {b, b, b};
  r.cases[0].engines.push_back(other);
  r.cases[0].timing_rounds = 3;
  r.cases[0].timing_floor = floor;
  return r.cases[0];
}

TEST(Timing, ARatioInsideTheNoiseFloorIsNotResolved) {
  EXPECT_FALSE(timing_pairs(two(1.0, 1.04, 1.05)).at(0).resolved);
  EXPECT_FALSE(timing_pairs(two(1.04, 1.0, 1.05)).at(0).resolved);
  EXPECT_TRUE(timing_pairs(two(1.0, 1.06, 1.05)).at(0).resolved);
  // No floor was measured: nothing is known
  EXPECT_FALSE(timing_pairs(two(1.0, 9.0, not_a_number)).at(0).resolved);
}

TEST(Timing, IsWrittenAndReadBackWithItsVerdicts) {
  auto r = green();
  r.cases[0] = two(1.0, 1.04, 1.05);
  const TestFolder folder;
  write_text(folder / "results.json", results_text(r));
  EXPECT_NE(results_text(r).find("\"verdict\": \"not resolved\""), std::string::npos);
  EXPECT_EQ(results_text(read_results(folder / "results.json")), results_text(r));
}

TEST(Timing, EveryRunIsMadeInEveryRoundAndTheFirstRunsOwnFilesStay) {
  const TestFolder folder;
  const auto value = read_flight_case(folder);
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  const std::vector<EngineEntry> engines{ask_engine(fake_engine(folder, ""))};
  auto result = run_suite({value}, engines, options).cases.at(0);
  time_case(value, engines, 3, options, result);
  const auto& run = result.engines.at(0).runs.at(0);
  EXPECT_EQ(run.cost.repeats.size(), 3u);
  EXPECT_GE(result.timing_floor, 1.0);
  EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + run.folder + "/result.json")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/timing"));
}

}  // namespace
}  // namespace tripoint
