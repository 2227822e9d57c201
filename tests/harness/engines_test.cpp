// SPDX-License-Identifier: BSD-3-Clause
// Engines that do something wrong: the suite goes on, and the row says what it was.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "harness/fakes.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* required = "[engines.fake]\nrequired = true\n";

EngineRow row_of(const std::string& wrong, double wall_limit = 60.0) {
  const TestFolder folder;
  return fly(folder, wrong, required, wall_limit).engines.at(0);
}

TEST(Engines, AnEngineThatIsKilledInMidRunIsARowThatNamesTheSignal) {
  const auto row = row_of("is killed");
  EXPECT_EQ(row.status, Status::killed);
  EXPECT_NE(row.reason.find("signal 9"), std::string::npos) << row.reason;
}

TEST(Engines, AnEngineThatHangsIsStoppedAtItsLimit) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(row_of("hangs", 1.0).status, Status::timeout);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
}

TEST(Engines, AFloodOnStderrIsCutToAMegabyteAndDoesNotStopTheRun) {
  const TestFolder folder;
  const auto c = fly(folder, "floods");
  EXPECT_EQ(c.exit_code, exit_pass);
  const auto size = std::filesystem::file_size(folder / "out/runs/test/flight/fake/base/log.txt");
  EXPECT_GT(size, 1u << 20);  // 64 MB were written
  EXPECT_LT(size, (1u << 20) + 10'000u);
}

TEST(Engines, AnErrorOfTheEngineIsGivenInItsOwnWords) {
  const auto row = row_of("ends with an error");
  EXPECT_EQ(row.status, Status::killed);  // no result.json, whatever the exit code
  EXPECT_NE(row.reason.find("Unrecognized fix style"), std::string::npos) << row.reason;
}

TEST(Engines, ATornResultIsAnError) { EXPECT_EQ(row_of("torn result").status, Status::error); }

TEST(Engines, ARefusalCarriesItsReasonAndFailsOnlyWhereTheEngineIsRequired) {
  const TestFolder folder;
  const auto must = fly(folder, "refuses", required);
  EXPECT_EQ(must.engines.at(0).status, Status::refused);
  EXPECT_EQ(must.engines.at(0).reason, "it has no conduction");
  EXPECT_EQ(must.exit_code, exit_missing);
}

TEST(Engines, AnAbsentEngineThatIsNotRequiredChangesNoExitCode) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[engines.gone]\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake", "gone"};
  const auto c = run_suite({value}, {ask_engine(fake_engine(folder, "nothing"))}, options).cases.at(0);
  ASSERT_EQ(c.engines.size(), 2u);
  EXPECT_EQ(c.engines[0].name, "gone");
  EXPECT_EQ(c.engines[0].status, Status::missing);
  EXPECT_FALSE(c.engines[0].reason.empty());
  EXPECT_EQ(c.exit_code, exit_pass);
}

TEST(Engines, AnEngineWhoseLibraryIsMissingSaysSoInItsRow) {
  const auto row = row_of("not there");
  EXPECT_EQ(row.status, Status::missing);
  EXPECT_EQ(row.reason, "its library is not installed");
}

TEST(Engines, AnEngineThatAnswersInfoLateOrWithRubbishIsNotAvailable) {
  const TestFolder folder;
  EXPECT_FALSE(ask_engine(fake_engine(folder, "broken info")).available);
  const auto slow = ask_engine(fake_engine(folder, "slow info"));
  EXPECT_FALSE(slow.available);
  EXPECT_NE(slow.reason.find("was stopped after 10 s"), std::string::npos) << slow.reason;
}

TEST(Engines, ADivergenceIsNamedWithParticleFieldStageAndTime) {
  const TestFolder folder;
  const auto c = fly(folder, "diverges", required);
  EXPECT_EQ(c.exit_code, exit_diverged);
  EXPECT_EQ(c.engines.at(0).reason, "velocity of particle 3 in stage kick at t = 0.1 s: blew up");
}

TEST(Engines, OneEngineThatFailsDoesNotStopTheOthers) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[engines.good]\n[engines.bad]\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.jobs = 2;
  options.selection.engines = {"good", "bad"};
  const auto c = run_suite({value},
                           {ask_engine(fake_engine(folder, "is killed", "bad")),
                            ask_engine(fake_engine(folder, "nothing", "good"))},
                           options)
                     .cases.at(0);
  ASSERT_EQ(c.engines.size(), 2u);
  EXPECT_EQ(fmt::format("{} {}", c.engines[0].name, c.engines[0].status), "good ok");
  EXPECT_EQ(fmt::format("{} {}", c.engines[1].name, c.engines[1].status), "bad killed");
  EXPECT_EQ(c.exit_code, exit_missing);  // the gate is for every engine, and one of them broke off
  EXPECT_EQ(fmt::format("{} {}", c.engines[0].gates.at(0).verdict, c.engines[1].gates.at(0).verdict),
            "pass missing");
}

TEST(Engines, AnEngineThatHoldsAnotherSceneIsNotComparable) {
  for (const auto& [wrong, word] :
       {std::pair{"holds another gravity", "gravity"}, std::pair{"holds another mass", "mass of cube"}}) {
    const TestFolder folder;
    const auto c = fly(folder, wrong);
    EXPECT_EQ(c.exit_code, exit_missing);
    EXPECT_NE(c.engines.at(0).reason.find(std::string("not comparable: ") + word), std::string::npos)
        << c.engines.at(0).reason;
  }
}

TEST(Engines, OnePerCentOfGravityTurnsTheAccuracyGateRed) {
  const TestFolder folder;
  const auto c = fly(folder, "one per cent of gravity");
  EXPECT_EQ(c.exit_code, exit_fail);
  EXPECT_NEAR(c.engines.at(0).gates.at(0).value, 0.5 * 0.0981 * 0.25, 1e-9);  // half of 1 % of g, times T^2
}

TEST(Engines, EveryRunIsPaidFor) {
  const auto row = row_of("nothing");
  EXPECT_GT(row.runs.at(0).cost.cpu_s, 0.0);
  EXPECT_GT(row.runs.at(0).cost.peak_bytes, 1e6);
}

}  // namespace
}  // namespace tripoint
