// SPDX-License-Identifier: BSD-3-Clause
// What an engine of unknown origin can do to the suite, its files and its names; none of it ends green.
#include <gtest/gtest.h>
#include <stdlib.h>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace {

/// The folders of TRIPOINT_ENGINE_PATH for the time of one test.
class EnginePath {
 public:
  explicit EnginePath(const std::string& folders) { ::setenv("TRIPOINT_ENGINE_PATH", folders.c_str(), 1); }
  ~EnginePath() { ::unsetenv("TRIPOINT_ENGINE_PATH"); }
  EnginePath(const EnginePath&) = delete;
  EnginePath& operator=(const EnginePath&) = delete;
};

TEST(NeverFailsThirdParty, Way30TheReportOfAnEarlierCallIsSetAsideBeforeAnythingIsRead) {
  const TestFolder folder;
  for (const char* name : {"results.json", "junit.xml", "summary.md", "index.html"})
    write_text(folder / name, "old");
  set_aside_report(folder / ".");
  for (const char* name : {"results.json", "junit.xml", "summary.md", "index.html"})
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
  EXPECT_TRUE(std::filesystem::exists(folder / "results.previous.json"));
}

TEST(NeverFailsThirdParty, Way31ATrajectoryThatWasSwappedIsNotKeptOnResume) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[engines.fake]\nrequired = true\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  const auto wrong = ask_engine(fake_engine(folder, "one per cent of gravity"));
  ASSERT_EQ(run_suite({value}, {wrong}, options).exit_code, exit_fail);
  SuiteOptions right = options;
  right.out = folder / "right";
  const TestFolder other;
  ASSERT_EQ(run_suite({value}, {ask_engine(fake_engine(other, "nothing"))}, right).exit_code, exit_pass);
  const std::string below = "/runs/test/flight/fake/base/trajectory.csv";
  std::filesystem::copy_file(right.out + below, options.out + below,
                             std::filesystem::copy_options::overwrite_existing);
  options.resume = true;
  EXPECT_EQ(run_suite({value}, {wrong}, options).exit_code, exit_fail);
}

TEST(NeverFailsThirdParty,
     Way32AnEngineThatWritesIntoTheSharedParticlesIsAnErrorAndTheNextOneFindsThemWhole) {
  const TestFolder folder;
  const auto value =
      read_flight_case(folder, "[engines.a-bad]\nrequired = true\n[engines.good]\nrequired = true\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"a-bad", "good"};
  const auto c = run_suite({value},
                           {ask_engine(fake_engine(folder, "writes into the particles", "a-bad")),
                            ask_engine(fake_engine(folder, "nothing", "good"))},
                           options)
                     .cases.at(0);
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_NE(c.engines.at(0).reason.find("the particles that all engines start from were changed"),
            std::string::npos)
      << c.engines.at(0).reason;
  EXPECT_EQ(c.engines.at(1).status, Status::ok) << c.engines.at(1).reason;
}

TEST(NeverFailsThirdParty, Way33AnEngineThatTakesTheNameOfAnotherIsRefusedByName) {
  const TestFolder folder;
  const auto impostor = fake_engine(folder, "nothing", "tripoint");
  try {
    (void)discover_engines({impostor});
    FAIL() << "it was taken";
  } catch (const EngineError& e) {
    EXPECT_NE(std::string(e.what()).find("calls itself tripoint"), std::string::npos) << e.what();
  }
}

TEST(NeverFailsThirdParty, AnEngineOfAnotherFileNameIsAskedWhateverNamesAreWanted) {
  const TestFolder folder;
  const auto mine = fake_engine(folder, "nothing", "mine");
  const auto other = folder / "engine-another-file";
  std::filesystem::rename(mine, other);
  const auto engines = discover_engines_wanted({"exact"}, {other});
  ASSERT_EQ(engines.size(), 2U);
  EXPECT_NE(find_engine(engines, "exact"), nullptr);
  EXPECT_NE(find_engine(engines, "mine"), nullptr);
}

TEST(NeverFailsThirdParty, Way38AFolderOfThePathThatHoldsNoEngineIsRefused) {
  const TestFolder folder;
  const EnginePath path(folder / ".");
  EXPECT_THROW((void)discover_engines(), EngineError);
}

TEST(NeverFailsThirdParty, Way39AnEngineOnThePathThatCannotBeStartedIsARowAndNotNothing) {
  const TestFolder folder;
  write_text(folder / "engine-mine", "#!/bin/sh\n");
  const EnginePath path(folder / ".");
  const auto engines = discover_engines();
  const auto* mine = find_engine(engines, "mine");
  ASSERT_NE(mine, nullptr);
  EXPECT_TRUE(mine->joins);
  EXPECT_FALSE(mine->available);
  EXPECT_NE(mine->reason.find("is not executable"), std::string::npos) << mine->reason;
}

TEST(NeverFailsThirdParty, Way40ANameThatLeadsOutOfTheReportOrLooksLikeAnotherIsRefused) {
  for (const char* name : {"../../exact", "trip\xd0\xbeint", "exact ", ""}) {
    const TestFolder folder;
    const auto path = folder / "engine-mine";
    write_text(path, std::string("#!/bin/sh\necho '{\"contract\": 1, \"name\": \"") + name +
                         "\", \"version\": \"1\"}'\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    const auto engine = ask_engine(path);
    EXPECT_FALSE(engine.available) << name;
    EXPECT_EQ(engine.name, "mine") << name;
  }
}

TEST(NeverFailsThirdParty, Way41ARequiredEngineThatNoGateLooksAtIsMissing) {
  auto r = green();
  auto second = engine(r);
  second.name = "second";
  r.cases[0].engines.push_back(second);
  r.cases[0].gates[0].engine = "tripoint";
  EXPECT_EQ(exit_of(r), exit_missing);
  r.cases[0].engines[1].required = false;
  EXPECT_EQ(exit_of(r), exit_pass);
}

TEST(NeverFailsThirdParty, Way42AGateForAPresetThatNobodyHasIsNotExcusedByAChoiceOfEngines) {
  auto r = green();
  auto none = limit("error", 0.1);
  none.engine = "tripoint";
  none.preset = "no-such";
  r.cases[0].gates.push_back(none);
  r.only_engines = {"tripoint"};
  EXPECT_EQ(exit_of(r), exit_missing);
  r.cases[0].gates[1].engine = "bullet";
  r.cases[0].gates[1].preset.clear();
  EXPECT_EQ(exit_of(r), exit_pass);
}

TEST(NeverFailsThirdParty, Way43AnOptionalEngineThatBreaksOffIsAFailedTestAndNotASkippedOne) {
  auto r = green();
  auto second = engine(r);
  second.name = "second";
  second.required = false;
  second.runs[0].status = Status::killed;
  second.runs[0].reason = "signal 11";
  r.cases[0].engines.push_back(second);
  judge(r);
  EXPECT_EQ(r.exit_code, exit_missing);
  EXPECT_NE(junit_text(r).find("name=\"second runs\"><failure"), std::string::npos) << junit_text(r);
}

TEST(NeverFailsThirdParty, Way44StatedErrorsSoLargeThatNothingCanBeSaidAreNotAPass) {
  auto r = green();
  error(r) = value(0.0, 10.0);
  EXPECT_EQ(exit_of(r), exit_inconclusive);
}

}  // namespace
}  // namespace tripoint
