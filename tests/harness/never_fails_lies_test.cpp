// SPDX-License-Identifier: BSD-3-Clause
// Lies of an engine, or of the files around it, that once ended green.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/run/run_one.hpp"

namespace tripoint {
namespace {

/// The flight with something of its case in other words, on one fake engine.
CaseResult fly_as(const std::string& from, const std::string& to,
                  const std::string& wrong = "one per cent of gravity") {
  const TestFolder folder;
  auto text = flight_case();
  text.replace(text.find(from), from.size(), to);
  write_text(folder / "cases/test/flight.toml", text);
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  return run_suite({read_case(folder / "cases/test/flight.toml").value},
                   {ask_engine(fake_engine(folder, wrong))}, options)
      .cases.at(0);
}

std::string why_of(const CaseResult& c) {
  return c.engines.at(0).gates.empty() ? "" : c.engines.at(0).gates.at(0).why;
}

TEST(NeverFailsLies, Way45AWindowThatHoldsOnlyTheStartJudgesNothing) {
  for (const char* words : {"norm = \"max\"\nwindow = [0.0, 0.001]", "norm = \"Linf\"\nat = \"0\""}) {
    const auto c = fly_as("norm = \"max\"", words);
    EXPECT_NE(c.exit_code, exit_pass) << words;
    EXPECT_NE(why_of(c).find("only the start"), std::string::npos) << why_of(c);
  }
}

TEST(NeverFailsLies, Way46AUnitThatTheNumberDoesNotHaveIsNoUnit) {
  const auto c = fly_as("unit = \"m\"", "unit = \"mm\"");
  EXPECT_NE(c.exit_code, exit_pass);
  EXPECT_NE(why_of(c).find("write scale = 0.001"), std::string::npos) << why_of(c);
  EXPECT_EQ(fly_as("unit = \"m\"", "unit = \"mm\"\nscale = 1e-3", "nothing").exit_code, exit_pass);
  EXPECT_EQ(fly_as("unit = \"m\"", "unit = \"of the cube's side\"", "nothing").exit_code, exit_pass);
}

TEST(NeverFailsLies, Way47ATrajectoryThatIsALinkIsNotTheEnginesOwn) {
  for (const char* wrong : {"links elsewhere", "hard link elsewhere"}) {
    const TestFolder folder;
    const auto value =
        read_flight_case(folder, "[engines.a-good]\nrequired = true\n[engines.mine]\nrequired = true\n");
    SuiteOptions options;
    options.out = folder / "out";
    options.selection.engines = {"a-good", "mine"};
    const auto c = run_suite({value},
                             {ask_engine(fake_engine(folder, "nothing", "a-good")),
                              ask_engine(fake_engine(folder, wrong, "mine"))},
                             options)
                       .cases.at(0);
    EXPECT_EQ(c.exit_code, exit_missing) << wrong;
    EXPECT_NE(c.engines.at(1).reason.find("is a link to another file"), std::string::npos)
        << c.engines.at(1).reason;
    EXPECT_EQ(c.engines.at(0).status, Status::ok) << c.engines.at(0).reason;
  }
}

TEST(NeverFailsLies, Way48ASecondRowForTheSameBodyAndTimeDoesNotReplaceTheFirst) {
  const TestFolder folder;
  const auto c = fly(folder, "says everything twice", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_NE(c.engines.at(0).reason.find("has a row already"), std::string::npos) << c.engines.at(0).reason;
}

TEST(NeverFailsLies, Way52AColumnOfOtherTimesThanThePlacesIsNotOfTheFrame) {
  const TestFolder folder;
  const auto c = fly(folder, "columns of other times", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_NE(c.engines.at(0).reason.find("velocity is of 0.01"), std::string::npos) << c.engines.at(0).reason;
}

TEST(NeverFailsLies, Way49AnotherEnginesDivergenceDoesNotStandForTheOneThatIsRequired) {
  auto r = green();
  r.cases[0].expect = Expect::diverges;
  r.cases[0].gates.clear();
  auto other = engine(r);
  other.name = "mine";
  other.required = false;
  other.runs[0].status = Status::diverged;
  r.cases[0].engines.push_back(other);
  EXPECT_EQ(exit_of(r), exit_fail);
  engine(r).runs[0].status = Status::diverged;
  EXPECT_EQ(exit_of(r), exit_pass);
  for (auto& e : r.cases[0].engines) e.required = false;
  EXPECT_EQ(exit_of(r), exit_pass);
  engine(r).runs[0].status = Status::ok;  // none is required: all that ran are meant
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(NeverFailsLies, Way50AnEngineThatWasAskedForAndRefusesThePartThatItWouldFailIsMissing) {
  auto r = green();
  auto& e = engine(r);
  e.required = false;
  auto finest = e.runs[0];
  finest.base = false;
  finest.status = Status::refused;
  finest.reason = "too fine";
  finest.group = "fine";
  finest.metrics.clear();
  e.runs.push_back(finest);
  EXPECT_EQ(exit_of(r), exit_pass) << "an engine that nobody asked for may";
  r.asked = {"tripoint"};
  EXPECT_EQ(exit_of(r), exit_missing);
  judge(r);
  EXPECT_NE(r.problems.at(0).find("refused the rest"), std::string::npos) << r.problems.at(0);
}

TEST(NeverFailsLies, Way51AnEngineWhoseProgramHasChangedIsRunAgainOnResume) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[engines.fake]\nrequired = true\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  options.resume = true;
  ASSERT_EQ(run_suite({value}, {ask_engine(fake_engine(folder, "nothing"))}, options).exit_code, exit_pass);
  const TestFolder other;  // the same name and version, and another program
  EXPECT_EQ(
      run_suite({value}, {ask_engine(fake_engine(other, "one per cent of gravity"))}, options).exit_code,
      exit_fail);
}

}  // namespace
}  // namespace tripoint
