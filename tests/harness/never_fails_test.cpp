// SPDX-License-Identifier: BSD-3-Clause
// The sixteen ways in which gates elsewhere were seen never to fail; here each one must fail.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "core/errors.hpp"

namespace tripoint {
namespace {

TEST(SixteenWays, TheGateThatTheyBreakIsGreenWithoutThem) {
  EXPECT_EQ(exit_of(green()), exit_pass);
  const TestFolder folder;
  EXPECT_EQ(fly(folder, "nothing").exit_code, exit_pass);
}

TEST(SixteenWays, Way01ANumberThatIsNotFiniteFails) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    auto r = green();
    error(r).value = bad;
    EXPECT_EQ(exit_of(r), exit_fail);
  }
}

TEST(SixteenWays, Way02NonFiniteSamplesAreNotDroppedBeforeTheNorm) {
  const TestFolder folder;
  const auto c = fly(folder, "not a number");
  EXPECT_NE(c.exit_code, exit_pass);
  auto r = green();
  error(r).uncertainty.numerical = std::nan("");  // nor is an uncertainty that could not be formed taken for none
  EXPECT_NE(exit_of(r), exit_pass);
}

TEST(SixteenWays, Way03AShorterTrajectoryIsNotJudgedOnItsLength) {
  const TestFolder folder;
  const auto c = fly(folder, "stops early", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_EQ(c.engines.at(0).status, "error");
  EXPECT_TRUE(c.engines.at(0).gates.empty() || c.engines.at(0).gates[0].verdict == "missing");
}

TEST(SixteenWays, Way04AMissingMetricIsNotSkipped) {
  auto r = green();
  engine(r).runs[0].metrics.clear();
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  engine(r).runs.clear();
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();  // beside a gate that is green too
  r.cases[0].gates.push_back(limit("absent", 0.1));
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(SixteenWays, Way05AGateWithoutALimitOrAReasonIsNoGate) {
  auto r = green();
  r.cases[0].gates[0].limit.reset();
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  r.cases[0].gates[0].reason.clear();
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(SixteenWays, Way06EveryMetricIsComparedNotTheFirst) {
  auto r = green();
  engine(r).runs[0].metrics["second"] = value(1.0);
  r.cases[0].gates.push_back(limit("second", 0.1));
  EXPECT_EQ(exit_of(r), exit_fail);
  r = green();  // and every run, not the first
  engine(r).runs.push_back(run_with({{"error", value(1.0)}}));
  engine(r).runs.back().group = "another";
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(SixteenWays, Way07AnErrorOfZeroIsNotAReasonToPassWhatMustHaveMoved) {
  auto r = green();
  error(r).value = 0.0;
  r.cases[0].gates[0].limit.reset();
  r.cases[0].gates[0].at_least = 0.01;  // liveness
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(SixteenWays, Way08TheReferenceIsNotJudgedAgainstItself) {
  auto r = green();
  engine(r).name = "exact";
  EXPECT_EQ(exit_of(r), exit_missing);  // no other engine: the gate judges nothing
}

TEST(SixteenWays, Way09AFrozenSceneIsNotPerfectBecauseItConserves) {
  const TestFolder folder;
  EXPECT_NE(fly(folder, "frozen", "[engines.fake]\nrequired = true\n").exit_code, exit_pass);
}

TEST(SixteenWays, Way10TooSmallIsAsWrongAsTooLarge) {
  auto r = green();
  error(r).value = -1.0;
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(SixteenWays, Way11AnErrorThatGrowsIsNotAnOrder) {
  EXPECT_EQ(exit_of(study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3})), exit_pass);
  EXPECT_EQ(exit_of(study_of({2.5e-3, 1.0e-2, 4.0e-2, 1.6e-1})), exit_fail);
}

TEST(SixteenWays, Way12AnEngineThatExitsZeroWithoutAResultIsKilled) {
  const TestFolder folder;
  const auto c = fly(folder, "leaves no result", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.engines.at(0).status, "killed");
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_EQ(fly(folder, "says ok and exits 3", "[engines.fake]\nrequired = true\n").exit_code, exit_missing);
}

TEST(SixteenWays, Way13AReplicaIsPooledAndNotARetry) {
  auto r = green();
  engine(r).runs.push_back(engine(r).runs[0]);
  error(r).value = 0.5;  // one bad, one good: the mean is over the limit, whatever the better one says
  EXPECT_NE(exit_of(r), exit_pass);
  EXPECT_NE(exit_of(study_of({1.6e-1, 4.0e-2})), exit_pass);  // and too little history does not switch the test off
}

TEST(SixteenWays, Way14TheResultOfAnEarlierRunIsNotJudged) {
  const TestFolder folder;
  ASSERT_EQ(fly(folder, "nothing").exit_code, exit_pass);
  const auto stale = folder / "out/runs/test/flight/fake/base/result.json";
  ASSERT_TRUE(std::filesystem::exists(stale));
  const auto c = fly(folder, "leaves no result", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.engines.at(0).status, "killed");
  EXPECT_EQ(c.exit_code, exit_missing);
}

TEST(SixteenWays, Way15AnEmptySuiteAShadowedIdAndATagOfNothingAreErrors) {
  Results none;
  EXPECT_EQ(exit_of(none), exit_missing);
  auto r = green();
  r.planned.push_back("test/two");
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  r.cases.push_back(r.cases[0]);
  EXPECT_EQ(exit_of(r), exit_missing);
  const TestFolder folder;
  write_text(folder / "a/test/flight.toml", flight_case());
  write_text(folder / "b/test/flight.toml", flight_case());
  CaseFilter filter;
  filter.what = {folder / "a", folder / "b"};
  EXPECT_THROW((void)select_cases(filter), InputError);
  filter.what = {folder / "a"};
  EXPECT_EQ(select_cases(filter).size(), 1u);
  filter.tag = "no-such-tag";
  EXPECT_THROW((void)select_cases(filter), InputError);
}

TEST(SixteenWays, Way16AFailedRunAWrongUnitAndAShiftedTimeAxisAreSeen) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3, 6.0e-4});
  engine(r).runs[4].status = "killed";  // dropping it would leave four good levels
  EXPECT_EQ(exit_of(r), exit_missing);
  r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  engine(r).runs.push_back(engine(r).runs[3]);
  engine(r).runs[4].status = "killed";  // nor is a replica dropped that failed, of an engine that nobody requires
  engine(r).required = false;
  EXPECT_EQ(exit_of(r), exit_missing);
  for (const char* wrong : {"millimetres", "shifted time axis"}) {
    const TestFolder folder;
    EXPECT_NE(fly(folder, wrong, "[engines.fake]\nrequired = true\n").exit_code, exit_pass) << wrong;
  }
}

}  // namespace
}  // namespace tripoint
