// SPDX-License-Identifier: BSD-3-Clause
// The ways in which gates were seen never to fail, sixteen of them elsewhere and the others here; each one
// must fail.
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace {

TEST(NeverFails, TheGateThatTheyBreakIsGreenWithoutThem) {
  EXPECT_EQ(exit_of(green()), exit_pass);
  const TestFolder folder;
  EXPECT_EQ(fly(folder, "nothing").exit_code, exit_pass);
}

TEST(NeverFails, Way01ANumberThatIsNotFiniteFails) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    auto r = green();
    error(r).value = bad;
    EXPECT_EQ(exit_of(r), exit_fail);
  }
}

TEST(NeverFails, Way02NonFiniteSamplesAreNotDroppedBeforeTheNorm) {
  const TestFolder folder;
  const auto c = fly(folder, "not a number");
  EXPECT_NE(c.exit_code, exit_pass);
  auto r = green();
  // Nor is an uncertainty that could not be formed taken for none
  error(r).uncertainty.numerical = std::nan("");
  EXPECT_NE(exit_of(r), exit_pass);
}

TEST(NeverFails, Way03AShorterTrajectoryIsNotJudgedOnItsLength) {
  const TestFolder folder;
  const auto c = fly(folder, "stops early", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_EQ(c.engines.at(0).status, Status::error);
  EXPECT_TRUE(c.engines.at(0).gates.empty() || c.engines.at(0).gates[0].verdict == Verdict::missing);
}

TEST(NeverFails, Way04AMissingMetricIsNotSkipped) {
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

TEST(NeverFails, Way05AGateWithoutALimitOrAReasonIsNoGate) {
  auto r = green();
  r.cases[0].gates[0].limit.reset();
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  r.cases[0].gates[0].reason.clear();
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(NeverFails, Way06EveryMetricIsComparedNotTheFirst) {
  auto r = green();
  engine(r).runs[0].metrics["second"] = value(1.0);
  r.cases[0].gates.push_back(limit("second", 0.1));
  EXPECT_EQ(exit_of(r), exit_fail);
  r = green();  // and every run, not the first
  engine(r).runs.push_back(run_with({{"error", value(1.0)}}));
  engine(r).runs.back().group = "another";
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(NeverFails, Way07AnErrorOfZeroIsNotAReasonToPassWhatMustHaveMoved) {
  auto r = green();
  error(r).value = 0.0;
  r.cases[0].gates[0].limit.reset();
  r.cases[0].gates[0].at_least = 0.01;  // liveness
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(NeverFails, Way08TheReferenceIsNotJudgedAgainstItself) {
  auto r = green();
  engine(r).name = "exact";
  EXPECT_EQ(exit_of(r), exit_missing);  // no other engine: the gate judges nothing
}

TEST(NeverFails, Way09AFrozenSceneIsNotPerfectBecauseItConserves) {
  const TestFolder folder;
  EXPECT_NE(fly(folder, "frozen", "[engines.fake]\nrequired = true\n").exit_code, exit_pass);
}

TEST(NeverFails, Way10TooSmallIsAsWrongAsTooLarge) {
  auto r = green();
  error(r).value = -1.0;
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(NeverFails, Way11AnErrorThatGrowsIsNotAnOrder) {
  EXPECT_EQ(exit_of(study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3})), exit_pass);
  EXPECT_EQ(exit_of(study_of({2.5e-3, 1.0e-2, 4.0e-2, 1.6e-1})), exit_fail);
}

TEST(NeverFails, Way12AnEngineThatExitsZeroWithoutAResultIsKilled) {
  const TestFolder folder;
  const auto c = fly(folder, "leaves no result", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.engines.at(0).status, Status::killed);
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_EQ(fly(folder, "says ok and exits 3", "[engines.fake]\nrequired = true\n").exit_code, exit_missing);
}

TEST(NeverFails, Way13AReplicaIsPooledAndNotARetry) {
  auto r = green();
  engine(r).runs.push_back(engine(r).runs[0]);
  error(r).value = 0.5;  // one bad, one good: the mean is over the limit, whatever the better one says
  EXPECT_NE(exit_of(r), exit_pass);
  // And too little history does not switch the test off
  EXPECT_NE(exit_of(study_of({1.6e-1, 4.0e-2})), exit_pass);
}

TEST(NeverFails, Way14TheResultOfAnEarlierRunIsNotJudged) {
  const TestFolder folder;
  ASSERT_EQ(fly(folder, "nothing").exit_code, exit_pass);
  const auto stale = folder / "out/runs/test/flight/fake/base/result.json";
  ASSERT_TRUE(std::filesystem::exists(stale));
  const auto c = fly(folder, "leaves no result", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.engines.at(0).status, Status::killed);
  EXPECT_EQ(c.exit_code, exit_missing);
}

TEST(NeverFails, Way15AnEmptySuiteAShadowedIdAndATagOfNothingAreErrors) {
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
  write_text(folder / "a/test/baselines/flight.toml", "case_hash = \"1\"\n");  // of that case
  EXPECT_EQ(select_cases(filter).size(), 1u);
  filter.tag = "no-such-tag";
  EXPECT_THROW((void)select_cases(filter), InputError);
}

TEST(NeverFails, Way16AFailedRunAWrongUnitAndAShiftedTimeAxisAreSeen) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3, 6.0e-4});
  engine(r).runs[4].status = Status::killed;  // dropping it would leave four good levels
  EXPECT_EQ(exit_of(r), exit_missing);
  r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  engine(r).runs.push_back(engine(r).runs[3]);
  // Nor is a replica dropped that failed, of an engine that nobody requires
  engine(r).runs[4].status = Status::killed;
  engine(r).required = false;
  EXPECT_EQ(exit_of(r), exit_missing);
  for (const char* wrong : {"millimetres", "shifted time axis"}) {
    const TestFolder folder;
    EXPECT_NE(fly(folder, wrong, "[engines.fake]\nrequired = true\n").exit_code, exit_pass) << wrong;
  }
}

/// A second engine beside ours that ran and was asked for; the case's gate is for `judged` alone.
Results with_third_party(const std::string& judged) {
  auto r = green();
  auto mine = engine(r);
  mine.name = "mine";
  mine.required = false;
  r.cases[0].engines.push_back(mine);
  r.cases[0].gates[0].engine = judged;
  r.asked = {"mine"};
  return r;
}

TEST(NeverFails, Way17AnEngineThatWasAskedForDoesNotPassUnjudged) {
  EXPECT_EQ(exit_of(with_third_party("")), exit_pass);
  auto r = with_third_party("tripoint");
  judge(r);
  EXPECT_EQ(r.exit_code, exit_missing);
  EXPECT_NE(r.problems.at(0).find("mine was asked for"), std::string::npos) << r.problems.at(0);
  r.asked.clear();  // one that only joined changes no exit code, and is not counted as passing
  judge(r);
  EXPECT_EQ(r.exit_code, exit_pass);
  EXPECT_NE(case_line(r.cases[0]).find("mine: not judged"), std::string::npos) << case_line(r.cases[0]);
  EXPECT_NE(notes_text(r).find("not judged: mine in 1 case"), std::string::npos) << notes_text(r);
  EXPECT_NE(summary_text(r).find("mine ran and is not judged"), std::string::npos) << summary_text(r);
  EXPECT_NE(junit_text(r).find("name=\"mine is judged\"><skipped"), std::string::npos) << junit_text(r);
}

TEST(NeverFails, Way18AnEngineThatWasAskedForAndIsNotThereOrDidNotRunDoesNotPass) {
  for (const auto status :
       {Status::missing, Status::refused, Status::killed, Status::timeout, Status::error}) {
    auto r = with_third_party("");
    auto& mine = r.cases[0].engines[1];
    mine.status = status;
    mine.reason = "why";
    if (mine.status == Status::missing)
      mine.runs.clear();
    else {
      mine.runs[0].status = status;
      mine.runs[0].reason = "why";
    }
    judge(r);
    EXPECT_EQ(r.exit_code, exit_missing) << status;
    ASSERT_FALSE(r.problems.empty()) << status;
    EXPECT_NE(r.problems[0].find("mine was asked for"), std::string::npos) << r.problems[0];
  }
  auto r = with_third_party("");
  r.cases[0].engines.pop_back();  // nor is a row that was taken out of the results a pass
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(NeverFails, Way19APartOfASuiteMayLeaveTheJudgingToAnotherAndTheWholeMayNot) {
  auto r = with_third_party("tripoint");
  r.shard = "1/2";
  EXPECT_EQ(exit_of(r), exit_pass);
  r.shard = "1/1";
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(NeverFails, Way20AnEngineOnThePathJoinsEveryCaseAndIsJudgedByWhatEveryEngineMustHold) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[engines.tripoint]\nrequired = false\n");
  SuiteOptions options;
  options.out = folder / "out";
  auto wrong = ask_engine(fake_engine(folder, "one per cent of gravity", "mine"));
  wrong.joins = true;
  EXPECT_EQ(run_suite({value}, {wrong}, options).exit_code, exit_fail);
}

}  // namespace
}  // namespace tripoint
