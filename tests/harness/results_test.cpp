// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "core/durable_file.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/campaign/merge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

Results written_and_read(const Results& r) {
  const TestFolder folder;
  write_durably(folder / "results.json", results_text(r));
  return read_results(folder / "results.json");
}

int exit_of_stored(Results r) {
  judge(r);
  auto stored = written_and_read(r);
  judge(stored);
  return stored.exit_code;
}

TEST(ResultsFile, JudgedFromTheFileTheVerdictIsTheSame) {
  EXPECT_EQ(exit_of_stored(green()), exit_pass);
  EXPECT_EQ(exit_of_stored(study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3})), exit_pass);
  EXPECT_EQ(exit_of_stored(study_of({2.5e-3, 1.0e-2, 4.0e-2, 1.6e-1})), exit_fail);
  auto r = green();
  error(r).value = std::nan("");
  EXPECT_EQ(exit_of_stored(r), exit_fail);
  EXPECT_NE(results_text(r).find("\"finite\": false"), std::string::npos);
}

TEST(ResultsFile, KeepsTheLibraryOfAnEngineAndTheTagsOfACase) {
  auto r = green();
  r.cases[0].tags = {"table1", "feature-fluids"};
  r.cases[0].engines[0].library_path = "/lib/libx.so";
  r.cases[0].engines[0].library_hash = "fnv1a64:0123";
  const auto stored = written_and_read(r);
  EXPECT_EQ(stored.cases[0].tags, r.cases[0].tags);
  EXPECT_EQ(stored.cases[0].engines[0].library_path, "/lib/libx.so");
  EXPECT_EQ(stored.cases[0].engines[0].library_hash, "fnv1a64:0123");
  // An engine that tells none has no such key
  EXPECT_EQ(results_text(green()).find("\"library\""), std::string::npos);
}

TEST(ResultsFile, AStoredVerdictIsNotTrusted) {
  auto r = green();
  judge(r);
  error(r).value = 1.0;  // the rows still say pass
  auto stored = written_and_read(r);
  EXPECT_EQ(stored.verdict, CaseVerdict::pass);
  judge(stored);
  EXPECT_EQ(stored.exit_code, exit_fail);
}

TEST(ResultsFile, WhatIsNoResultsFileIsRefused) {
  const TestFolder folder;
  for (const char* text : {"", "{", "[]", "{\"format\": 2, \"cases\": []}", "{\"format\": 1}", "\x01\x02"}) {
    write_text(folder / "r/results.json", text);
    EXPECT_THROW((void)read_results(folder / "r/results.json"), InputError) << text;
  }
  EXPECT_THROW((void)read_results(folder / "absent.json"), InputError);
}

TEST(ResultsFile, ARowWithoutStatusOrWithAWordForANumberDoesNotPass) {
  const TestFolder folder;
  std::string text = results_text(green());
  const auto swap = [](std::string s, const std::string& from, const std::string& to) {
    const auto at = s.rfind(from);  // the run's own, not its engine's
    EXPECT_NE(at, std::string::npos) << from;
    return s.replace(at, from.size(), to);
  };
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"\"value\": 0.05", "\"value\": \"0.05\""},
        {"\"numerical\": 0.0", "\"numerical\": null"},
        {"\"status\": \"ok\"", "\"status\": 1"}}) {
    write_text(folder / "r/results.json", swap(text, from, to));
    auto r = read_results(folder / "r/results.json");
    judge(r);
    EXPECT_NE(r.exit_code, exit_pass) << to;
  }
}

TEST(ExitCodes, OfSeveralTheFirstOfTheContractCounts) {
  EXPECT_EQ(first_of({}), 0);
  EXPECT_EQ(first_of({6, 3, 1, 4, 7, 2, 5}), 5);
  EXPECT_EQ(first_of({6, 3, 1, 4, 7, 2}), 2);
  EXPECT_EQ(first_of({6, 3, 1, 4, 7}), 7);
  EXPECT_EQ(first_of({6, 3, 1, 4}), 4);
  EXPECT_EQ(first_of({6, 3, 1}), 1);
  EXPECT_EQ(first_of({6, 3}), 3);
  EXPECT_EQ(first_of({6}), 6);
}

TEST(Judge, AnUncertaintyThatReachesTheLimitIsInconclusiveAndNotGreen) {
  auto r = green();
  error(r).uncertainty.statistical = 0.03;  // 0.05 + 2 x 0.03 > 0.1
  EXPECT_EQ(exit_of(r), exit_inconclusive);
}

TEST(Judge, AnEngineThatNobodyRequiresMayNotRefuseOneSeedOfARun) {
  auto r = green();
  auto other = engine(r);
  other.name = "other";
  other.required = false;
  other.runs[0].metrics["error"] = value(7.0);  // far above the limit
  other.runs.push_back(run_with({}));
  other.runs[1].status = Status::refused;
  r.cases[0].engines.push_back(other);
  EXPECT_EQ(exit_of(r), exit_missing);  // the failing seed is not hidden by the one that was refused
  r.cases[0].engines[1].runs[0].status = Status::refused;
  EXPECT_EQ(exit_of(r), exit_pass);  // a run may be refused as a whole
}

TEST(Judge, AnEngineThatWasAskedForAndThatNoGateNamesIsToldHowManyCasesItRan) {
  auto r = green();
  r.cases[0].gates[0].engine = "tripoint";
  r.cases[0].engines.push_back(engine(r));
  r.cases[0].engines[1].name = "other";
  r.cases[0].engines[1].required = false;
  r.asked = {"other"};
  judge(r);
  EXPECT_EQ(r.exit_code, exit_missing);
  ASSERT_EQ(r.problems.size(), 1u);
  EXPECT_NE(r.problems[0].find("other was asked for, ran 1 case, and is not judged"), std::string::npos)
      << r.problems[0];
}

TEST(Judge, ARunThatBrokeOffIsNoRefusal) {
  for (const auto status : {Status::killed, Status::timeout, Status::error}) {
    auto r = green();
    r.cases[0].engines.push_back(engine(r));
    r.cases[0].engines[1].name = "other";
    r.cases[0].engines[1].required = false;
    r.cases[0].engines[1].runs[0].status = status;
    EXPECT_EQ(exit_of(r), exit_missing) << status;
  }
}

TEST(Judge, ADivergenceThatTheCaseDeclaresPassesAndItsAbsenceFails) {
  auto r = green();
  r.cases[0].expect = Expect::diverges;
  engine(r).runs[0].status = Status::diverged;
  EXPECT_EQ(exit_of(r), exit_pass);
  engine(r).runs[0].status = Status::ok;
  EXPECT_EQ(exit_of(r), exit_fail);
  r.cases[0].expect = Expect::pass;
  engine(r).runs[0].status = Status::diverged;
  EXPECT_EQ(exit_of(r), exit_diverged);
}

TEST(Judge, WhereThePrintedFormIsDeclaredToDivergeTheCorrectedOneMayNot) {
  auto r = green();
  r.cases[0].expect = Expect::paper_diverges;
  RunRow printed = engine(r).runs[0];
  printed.knobs.mode = JudgedMode::paper;
  printed.status = Status::diverged;
  engine(r).runs[0].knobs.mode = JudgedMode::corrected;
  engine(r).runs.push_back(printed);
  for (Gate& gate : r.cases[0].gates) gate.mode = JudgedMode::corrected;
  EXPECT_EQ(exit_of(r), exit_pass);
  engine(r).runs[1].status = Status::ok;
  EXPECT_EQ(exit_of(r), exit_fail) << "the declaration is stale";
  engine(r).runs[1].status = Status::diverged;
  engine(r).runs[0].status = Status::diverged;
  EXPECT_EQ(exit_of(r), exit_diverged);
}

TEST(Judge, ADeclaredDefectNeedsAGateThatMeasuresIt) {
  auto r = green();
  r.cases[0].expect = Expect::defect;
  EXPECT_EQ(exit_of(r), exit_missing);  // a ceiling alone is passed by no defect too
  r.cases[0].gates[0].limit.reset();
  r.cases[0].gates[0].band = {0.04, 0.06};
  EXPECT_EQ(exit_of(r), exit_pass);
}

TEST(Judge, AGateLooksOnlyAtItsModeLevelAndEngine) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  auto at_finest = limit("error", 3e-3);
  at_finest.level = 0.0125;
  r.cases[0].gates = {at_finest};
  EXPECT_EQ(exit_of(r), exit_pass);
  r.cases[0].gates[0].level = 0.05;
  EXPECT_EQ(exit_of(r), exit_fail);
  r.cases[0].gates[0].level = 0.07;  // no such level: judges nothing
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  r.cases[0].gates[0].mode = JudgedMode::paper;  // no such run
  EXPECT_EQ(exit_of(r), exit_missing);
  r = green();
  r.cases[0].gates[0].engine = "bullet";
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(Judge, TheClassThatAStudyDeclaresMustBeFound) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  r.cases[0].studies[0].order = 2.0;
  r.cases[0].studies[0].expect = FitClass::asymptotic;
  EXPECT_EQ(exit_of(r), exit_pass);
  r.cases[0].studies[0].expect = FitClass::plateau;
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(Pool, ReplicasHaveTheScatterOfTheirMean) {
  const auto pool = pooled({value(1.0), value(2.0), value(3.0)});
  EXPECT_DOUBLE_EQ(pool.value, 2.0);
  EXPECT_DOUBLE_EQ(pool.uncertainty.statistical, std::sqrt(2.0 / 2.0 / 3.0));  // s / sqrt(n)
}

TEST(Shards, MergedShardsHaveTheVerdictOfTheWholeSuite) {
  const TestFolder folder;
  auto whole = green();
  auto second = green().cases[0];
  second.id = "test/two";
  second.engines[0].runs[0].metrics["error"] = value(0.3);
  whole.cases.push_back(second);
  whole.planned.push_back("test/two");
  judge(whole);
  for (int k = 0; k < 2; ++k) {
    auto part = whole;
    part.cases = {whole.cases[static_cast<std::size_t>(k)]};
    part.planned = {part.cases[0].id};
    part.shard = std::to_string(k + 1) + "/2";
    judge(part);
    write_text(folder / ("s" + std::to_string(k) + "/results.json"), results_text(part));
  }
  const auto merged = merge_shards({folder / "s1", folder / "s0"});
  EXPECT_EQ(merged.exit_code, whole.exit_code);
  EXPECT_EQ(results_text(merged), results_text(whole));
  EXPECT_THROW((void)merge_shards({folder / "s0"}), InputError);
  EXPECT_THROW((void)merge_shards({folder / "s0", folder / "s0"}), InputError);
}

TEST(Reports, JUnitCountsAnInconclusiveGateAsAFailureOfItsOwnType) {
  auto r = green();
  error(r).uncertainty.statistical = 0.03;
  r.cases[0].gates[0].reason = "a < b & \"c\"";
  judge(r);
  const auto text = junit_text(r);
  EXPECT_NE(text.find("<failure type=\"inconclusive\""), std::string::npos);
  EXPECT_NE(text.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_NE(summary_text(r).find("INCONCLUSIVE"), std::string::npos);
}

}  // namespace
}  // namespace tripoint
