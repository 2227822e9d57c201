// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "sampling/sample.hpp"
#include "validation/mutation/seeds.hpp"

namespace tripoint {
namespace {

CaseResult with_value(double v) {
  auto r = green();
  error(r).value = v;
  judge(r);
  return r.cases[0];
}

TEST(Seeds, AreAskedOfJitterAndWalkersAndOfEnginesThatDrawLots) {
  const TestFolder folder;
  auto value = read_flight_case(folder);
  const EngineEntry certain;
  EngineEntry lots;
  lots.deterministic = false;
  const EnginePlan engine{"tripoint", "default", true, {}, &certain, {}};
  EXPECT_FALSE(depends_on_seed(value, engine, {}));
  EXPECT_TRUE(depends_on_seed(value, {"tripoint", "default", true, {}, &lots, {}}, {}));
  RunPlan walkers;
  walkers.walkers = 100.0;
  EXPECT_TRUE(depends_on_seed(value, engine, walkers));
  value.scene.jitter = 0.1;
  EXPECT_TRUE(depends_on_seed(value, engine, {}));
  EXPECT_FALSE(depends_on_seed(value, {"exact", "default", false, {}, &certain, {}}, {}));
}

TEST(Seeds, AGateThatTurnsWithOneOfThemIsAFalseAlarm) {
  SeedsOutcome all;
  all.seeds = 3;
  for (const auto& [seed, v] : {std::pair{1001u, 0.05}, std::pair{2001u, 0.06}, std::pair{3001u, 0.11}})
    add_seed(with_value(v), seed, all);
  settle(all);
  ASSERT_EQ(all.gates.size(), 1u);
  EXPECT_EQ(all.gates[0].alarms, std::vector<std::uint64_t>{3001});
  EXPECT_EQ(all.exit_code, exit_selftest);
  EXPECT_NE(seeds_table(all).find("1 false alarms"), std::string::npos) << seeds_table(all);
}

TEST(Seeds, ADivergenceThatTheCaseDeclaresIsNoAlarmAndAnotherIs) {
  for (const auto& [expect, code] :
       {std::pair{Expect::diverges, exit_pass}, std::pair{Expect::pass, exit_selftest}}) {
    auto r = green();
    r.cases[0].expect = expect;
    r.cases[0].gates.clear();
    engine(r).runs[0].status = Status::diverged;
    engine(r).runs[0].metrics.clear();
    judge(r);
    SeedsOutcome all;
    add_seed(r.cases[0], 1, all);
    settle(all);
    EXPECT_EQ(all.exit_code, code) << expect;
  }
}

TEST(Seeds, GatesThatJudgeTheSameLevelOfTwoStudiesAreNotMixed) {
  SeedsOutcome all;
  for (const unsigned seed : {1u, 2u}) {
    auto r = green();
    auto second = engine(r).runs[0];
    second.group = "other";
    second.base = false;
    second.metrics["error"].value = 0.01;
    engine(r).runs.push_back(second);
    judge(r);
    add_seed(r.cases[0], seed, all);
  }
  settle(all);
  ASSERT_EQ(all.gates.size(), 2u);
  EXPECT_EQ(all.gates[0].deviation, 0.0);
  EXPECT_EQ(all.gates[1].mean, 0.01);
}

TEST(Seeds, TheRoomLeftIsCountedInStandardDeviations) {
  SeedsOutcome all;
  for (const double v : {0.04, 0.05, 0.06}) add_seed(with_value(v), 1, all);
  settle(all);
  EXPECT_NEAR(all.gates.at(0).mean, 0.05, 1e-15);  // round-off
  EXPECT_NEAR(all.gates[0].deviation, 0.01, 1e-15);
  EXPECT_NEAR(all.gates[0].distance, 5.0, 1e-12);  // (0.1 - 0.05)/0.01
  EXPECT_EQ(all.exit_code, exit_pass);
}

TEST(Seeds, ACaseInWhichChanceHasNoHandIsNotRunAndProvesNothing) {
  const TestFolder folder;
  SelftestOptions options;
  options.out = folder / "out";
  EXPECT_THROW((void)try_seeds({read_flight_case(folder)}, {}, 2, options), InputError);
}

TEST(Seeds, AnotherSeedIsAnotherSampling) {
  const TestFolder folder;
  auto value = read_flight_case(folder);
  value.scene.jitter = 0.1;
  auto other = value;
  other.scene.seed += 1000;
  EXPECT_NE(sample(value.scene).position.at(0).x, sample(other.scene).position.at(0).x);
}

}  // namespace
}  // namespace tripoint
