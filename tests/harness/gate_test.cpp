// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "fakes.hpp"
#include "judged.hpp"
#include "kept.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/baseline/baseline_propose.hpp"
#include "validation/baseline/gate_verdict.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/judge/remarks.hpp"

namespace tripoint {
namespace {

Results judged(Results r) {
  judge(r);
  return r;
}

/// A measured value under this limit.
Results used(double measured, double most) {
  auto r = green();
  error(r).value = measured;
  r.cases[0].gates[0].limit = most;
  return judged(r);
}

TEST(Remarks, PointAtTheLineOfTheLimitInTheCaseFile) {
  auto r = green();
  error(r).value = 0.3;
  r.cases[0].gates[0].place = {"cases/test/one.toml", 17, 9};
  const auto text = annotations_text(verdict_remarks(judged(r)));
  EXPECT_EQ(
      text.rfind("::error file=cases/test/one.toml,line=17,title=test/one tripoint error::fail: 0.3", 0), 0u)
      << text;
}

TEST(Remarks, TheTenWorstAreAnnotatedAndTheLastSaysHowManyMoreThereAre) {
  auto r = green();
  const auto c = r.cases[0];
  r.cases.clear();
  for (int k = 0; k < 14; ++k) {
    r.cases.push_back(c);
    r.cases.back().id = "test/" + std::to_string(k);
    r.cases.back().engines[0].runs[0].metrics["error"] = value(0.2 + k);
  }
  r.planned.clear();
  const auto text = annotations_text(verdict_remarks(judged(r)));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_NE(text.find("test/13 "), std::string::npos);  // the farthest out
  EXPECT_EQ(text.find("test/3 "), std::string::npos);
  EXPECT_NE(text.find("and 4 more"), std::string::npos);
}

TEST(Remarks, WhatWouldEndAWorkflowCommandIsEscaped) {
  const std::vector<Remark> list{{true, 1, {"a,b:c.toml", 3, 0}, "t:1,2", "100 %\nnext", 1.0, {}}};
  EXPECT_EQ(annotations_text(list), "::error file=a%2Cb%3Ac.toml,line=3,title=t%3A1%2C2::100 %25%0Anext\n");
}

TEST(Headroom, ALimitThreeTimesTheErrorWarnsAndTenTimesFails) {
  EXPECT_TRUE(headroom_remarks(used(0.05, 0.1)).empty());
  EXPECT_FALSE(headroom_remarks(used(0.02, 0.1)).at(0).error);
  EXPECT_TRUE(headroom_remarks(used(0.009, 0.1)).at(0).error);
  EXPECT_TRUE(headroom_remarks(used(0.0, 0.1)).at(0).error);  // a metric that is dead is the slackest of all
}

TEST(Headroom, TheUncertaintyCountsAsUsed) {
  auto r = green();
  error(r) = value(0.001, 0.02);
  EXPECT_TRUE(headroom_remarks(judged(r)).empty());  // 0.1 over 0.041
}

TEST(Headroom, ADatedReasonIsShownAndDoesNotFail) {
  auto r = used(0.001, 0.1);
  r.cases[0].gates[0].date = "2026-11-21";
  const auto remarks = headroom_remarks(judged(r));
  EXPECT_FALSE(remarks.at(0).error);
  EXPECT_NE(remarks[0].text.find("2026-11-21"), std::string::npos);
}

TEST(Headroom, TheRunThatUsesMostOfAGateDecides) {
  auto r = green();
  auto coarse = engine(r).runs[0];
  coarse.base = false;
  coarse.group = "coarse";
  engine(r).runs.push_back(coarse);
  error(r).value = 1e-4;
  EXPECT_TRUE(headroom_remarks(judged(r)).empty());
}

TEST(Headroom, LimitsOfRoundOffAndCountsHaveNoneToGive) {
  EXPECT_TRUE(headroom_remarks(used(1e-16, 1e-10)).empty());
  EXPECT_FALSE(headroom_remarks(used(1e-16, 1e-9)).empty());
  auto r = used(0.0, 0.5);
  EXPECT_FALSE(headroom_remarks(r).empty());
  r.cases[0].metrics[0].quantity = "body_count";
  EXPECT_TRUE(headroom_remarks(r).empty());
}

TEST(Headroom, OrdersAndClassesHaveNoRoomToTighten) {
  GateRow row;
  row.metric = "error.order";
  row.verdict = Verdict::pass;
  row.value = 2.0;
  row.gate.at_least = 0.1;
  EXPECT_FALSE(headroom_of({}, row).has_value());
  row.metric = "error";
  EXPECT_TRUE(headroom_of({}, row).has_value());
  row.expect = FitClass::asymptotic;
  EXPECT_FALSE(headroom_of({}, row).has_value());
}

TEST(Headroom, ABandIsAskedOnBothSides) {
  auto r = green();
  auto& gate = r.cases[0].gates[0];
  gate.limit.reset();
  gate.band = {0.01, 0.06};
  EXPECT_EQ(headroom_of(r.cases[0], judged(r).cases[0].engines[0].gates[0]).value(), 5.0);  // 0.05 / 0.01
}

TEST(GateVerdict, AddsWhatTheResultsDoNotSayOfThemselves) {
  const TestFolder folder;
  auto r = green();
  r.cases[0].file = folder / "cases/test/one.toml";  // a file that is not there: what it asks cannot be seen
  r.filter_known = true;
  const auto verdict = gate_verdict(judged(r));
  EXPECT_EQ(verdict.code, exit_missing);
  EXPECT_NE(verdict.word, "PASS");
  EXPECT_FALSE(verdict.remarks.empty());
}

TEST(GateVerdict, SaysWhereTheResultsAreOfAnotherCommit) {
  const TestFolder folder;
  const auto says = [&](const std::string& commit) {
    auto r = green();
    r.cases[0].file = folder / "cases/test/one.toml";
    r.tool.commit = commit;
    const auto remarks = gate_verdict(judged(r)).remarks;
    return std::any_of(remarks.begin(), remarks.end(), [](const Remark& remark) {
      return remark.text.find("were made by commit") != std::string::npos && !remark.error &&
             remark.code == 0;
    });
  };
  EXPECT_TRUE(says("another"));
  EXPECT_FALSE(says(this_tool().commit));
}

TEST(Recheck, ACaseThatTheResultsLeaveOutIsAnError) {
  const TestFolder folder;
  write_text(folder / "cases/test/flight.toml", flight_case());
  auto r = green();
  r.cases.clear();
  r.planned.clear();
  r.filter_known = true;
  r.what = {folder / "cases"};
  const auto remarks = recheck_remarks(r);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_TRUE(remarks[0].error);
  EXPECT_EQ(remarks[0].code, exit_missing);
  EXPECT_NE(remarks[0].text.find("is not in them"), std::string::npos) << remarks[0].text;
}

TEST(Baselines, ThatAreNotThereYetAreNamedInOneWarningWhereTheSuiteKeepsThem) {
  Kept kept;
  kept.r.cases.push_back(kept.r.cases[0]);
  const auto remarks = baseline_remarks(kept.r);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_FALSE(remarks[0].error);
  EXPECT_NE(remarks[0].text.find("2 cases have no baseline yet"), std::string::npos) << remarks[0].text;
  std::filesystem::remove(kept.folder / "baselines");
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, ThatAreRequiredAreMissed) {
  Kept kept;
  EXPECT_EQ(baseline_remarks(kept.r, true).at(0).code, exit_missing);
  (void)kept.accept_all();
  EXPECT_TRUE(baseline_remarks(kept.r, true).empty());
}

TEST(Baselines, AGateThatIsGoneIsRedUntilThatIsAcceptedAndIsCounted) {
  Kept kept;
  auto second = limit("error", 0.2);
  kept.r.cases[0].gates.push_back(second);
  judge(kept.r);
  (void)kept.accept_all();
  kept.r.cases[0].gates.pop_back();
  judge(kept.r);
  EXPECT_EQ(baseline_remarks(kept.r).at(0).code, exit_missing);
  EXPECT_THROW((void)kept.accept_all(), InputError);
  EXPECT_THROW((void)kept.accept_all({.keep = true}), InputError) << "the case has no such gate any more";
  const auto said = kept.accept_all({.drop = true});
  EXPECT_NE(said.find("REMOVED, it was limit 0.2"), std::string::npos) << said;
  EXPECT_NE(said.find("and 1 were removed"), std::string::npos) << said;
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, AreAcceptedWithANoteForAnEngineThatTheCaseDoesNotName) {
  Kept kept;
  for (const auto& [engines, notes] : {std::pair{"", true}, {"\n[engines.tripoint]\n", false}}) {
    write_text(kept.folder / "cases/test/one.toml", flight_case() + engines);
    const auto said = kept.accept_all();
    EXPECT_EQ(said.find("test/one tripoint: note: the case names no such engine") != std::string::npos, notes)
        << said;
    EXPECT_EQ(read_baseline(kept.folder / "baselines/test/one.toml").engines.size(), 1u);
  }
}

TEST(Baselines, OfTheSuiteHoldNoEngineThatTheirCaseDoesNotName) {
  const auto suite = std::filesystem::path(TRIPOINT_SOURCE_DIR);
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(suite / "baselines")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    const auto hashes =
        case_hashes(suite / "cases" / std::filesystem::relative(entry.path(), suite / "baselines"));
    ASSERT_TRUE(hashes) << entry.path();
    for (const auto& g : read_baseline(entry.path()).gates)
      EXPECT_TRUE(hashes->required.contains(g.engine)) << entry.path() << ": " << g.engine;
  }
  EXPECT_GT(files, 200);
}

TEST(Baselines, AValueThatMovesByMoreThanTheDriftThatItsGateStatesIsRedBothWays) {
  Kept kept;
  kept.r.cases[0].gates[0].drift = 1e-6;
  judge(kept.r);
  (void)kept.accept_all();
  error(kept.r).value = 0.05 * (1.0 + 5e-7);  // another machine's round-off
  judge(kept.r);
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
  for (const double v : {0.05 * (1.0 + 2e-6), 0.05 * (1.0 - 2e-6)}) {
    error(kept.r).value = v;
    judge(kept.r);
    EXPECT_EQ(baseline_remarks(kept.r).at(0).code, exit_fail) << v;
  }
}

TEST(Baselines, InstructionsAreComparedWithWhatTheSameMachineCountedInTheSameWay) {
  Kept kept;
  auto& cost = engine(kept.r).runs[0].cost;
  cost.instructions = 1e6;
  cost.counted_by = "callgrind";
  kept.r.tool.cpu = "this one";
  (void)kept.accept_all();
  engine(kept.r).runs[0].cost.instructions = 1.02e6;
  EXPECT_EQ(baseline_remarks(kept.r).at(0).code, exit_cost);
  kept.r.tool.cpu = "another one";
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, WhatIsAcceptedIsReadBackAsItWas) {
  Kept kept;
  kept.r.cases[0].gates.at(0).drift = 0.125;
  judge(kept.r);
  (void)kept.accept_all();
  const auto b = read_baseline(kept.folder / "baselines/test/one.toml");
  EXPECT_EQ(baseline_text(b), baseline_text(accepted_from(kept.r.cases[0], kept.r.tool, kept.r.seed, nullptr,
                                                          {"2026-11-21", "abc", "a test"})));
  EXPECT_EQ(std::ranges::count(b.gates, std::optional(0.125), &AcceptedGate::drift), 1);
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, ThatWereWrittenAsTablesAreReadAsRows) {
  TestFolder folder;
  write_text(folder / "tables.toml", R"(format = 1
case = "test/one"
case_hash = "aa"
seed = 1

[[accepted]]
date = "2026-11-21"
commit = "abc"
reason = "a test"

[[gate]]
metric = "position"
engine = "tripoint"
mode = "corrected"
level = 0.5
allows = "band -0.1 to 0.3"
room = 0.2
value = 0.05
uncertainty = 0.01
band = [-0.1, 0.3]
measures = "bb"
first_room = 0.15
first_value = 0.04
loosened = 0.2876820724517809

[[cost]]
run = "tripoint/corrected"
pairs = 1000.0
steps = 10.0
)");
  const auto old = read_baseline(folder / "tables.toml");
  const auto rows = baseline_text(old);
  EXPECT_NE(
      rows.find(
          R"({ metric = "position", engine = "tripoint", mode = "corrected", level = 0.5, band = [-0.1, 0.3], value = 0.05, uncertainty = 0.01, first_room = 0.15, first_value = 0.04, loosened = 0.2876820724517809, measures = "bb" })"),
      std::string::npos)
      << rows;
  write_text(folder / "rows.toml", rows);
  const auto now = read_baseline(folder / "rows.toml");
  EXPECT_EQ(baseline_text(now), rows);
  ASSERT_EQ(now.gates.size(), 1U);
  EXPECT_EQ(now.gates[0].allows, "band -0.1 to 0.3");
  EXPECT_DOUBLE_EQ(now.gates[0].room, 0.2);
  EXPECT_EQ(now.cost.at(0).pairs, 1000.0);
  EXPECT_EQ(now.accepted.at(0).reason, "a test");
}

TEST(Baselines, ALooserLimitIsRedUntilItIsAccepted) {
  Kept kept;
  (void)kept.accept_all();
  kept.r.cases[0].gates[0].limit = 0.2;
  judge(kept.r);
  EXPECT_EQ(baseline_remarks(kept.r).at(0).code, exit_missing);
  const auto said = kept.accept_all();
  EXPECT_NE(said.find("limit 0.1 -> limit 0.2, LOOSER by a factor 2"), std::string::npos) << said;
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, ABandInThePlaceOfAFloorIsNoLooseningWhereItsLowerEdgeStays) {
  Kept kept;
  auto& gate = kept.r.cases[0].gates[0];
  gate.limit.reset();
  gate.at_least = 0.04;
  judge(kept.r);
  (void)kept.accept_all();
  gate.at_least.reset();
  gate.band = {0.04, 60.0};
  judge(kept.r);
  const auto said = kept.accept_all();
  EXPECT_NE(said.find("at least 0.04 -> band 0.04 to 60\n"), std::string::npos) << said;
  EXPECT_NE(said.find("0 limits were loosened"), std::string::npos) << said;
}

TEST(Baselines, TheSumOfAllLooseningsIsKeptAndTighteningTakesNothingOff) {
  Kept kept;
  std::string said;
  for (const double limit : {0.1, 0.2, 0.1, 0.3}) {
    kept.r.cases[0].gates[0].limit = limit;
    judge(kept.r);
    said = kept.accept_all();
  }
  const auto b = read_baseline(kept.folder / "baselines/test/one.toml");
  EXPECT_NEAR(b.gates.at(0).loosened, std::log(2.0) + std::log(3.0), 1e-12);  // round-off
  EXPECT_EQ(b.gates[0].first_room, 0.1);
  EXPECT_EQ(b.accepted.size(), 4u);
  EXPECT_NE(said.find("in all by a factor 6"), std::string::npos) << said;
}

TEST(Baselines, GatesAtLevelsFindTheirOwn) {
  Kept kept;
  auto& runs = engine(kept.r).runs;
  runs.push_back(runs[0]);
  runs[1].group = "fine";
  runs[1].levels = {{{Axis::spacing}, 0.05}};
  runs[0].levels = {{{Axis::spacing}, 0.1}};
  auto& gates = kept.r.cases[0].gates;
  gates.push_back(gates[0]);
  gates[0].level = 0.1;
  gates[1].level = 0.05;
  judge(kept.r);
  (void)kept.accept_all();
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
  gates[1].limit = 0.2;  // the finer one alone is loosened
  judge(kept.r);
  const auto remarks = baseline_remarks(kept.r);
  ASSERT_EQ(std::count_if(remarks.begin(), remarks.end(), [](const Remark& remark) { return remark.error; }),
            1);
}

TEST(Baselines, AreAcceptedByIdsThatTheResultsHold) {
  Kept kept;
  const Acceptance words{"2026-11-21", "abc", "a test"};
  EXPECT_THROW((void)accept(kept.r, {"test/other"}, words), InputError);
  EXPECT_EQ(accept(kept.r, {"test/one"}, words).find("nobody can build again"), std::string::npos);
  const std::string said = accept(kept.r, {"test/one"}, {words.date, "abc-dirty", words.reason});
  EXPECT_NE(said.find("note: measured by a tripoint of changed sources (abc-dirty)"), std::string::npos)
      << said;
}

TEST(Baselines, AProposalCountsTheLimitsThatWereLoosened) {
  Kept kept;
  (void)kept.accept_all();
  const Acceptance words{"2026-11-21", "abc", "a test"};
  EXPECT_EQ(proposals(kept.r, {}, words).at(0).limits_loosened, 0);
  kept.r.cases[0].gates[0].limit = 0.2;
  judge(kept.r);
  EXPECT_EQ(proposals(kept.r, {}, words).at(0).limits_loosened, 1);
}

TEST(Baselines, CreepIsSeenAgainstTheFirstValueToo) {
  Kept kept;
  for (const double v : {0.05, 0.053, 0.056}) {  // each step below a tenth
    error(kept.r).value = v;
    judge(kept.r);
    EXPECT_EQ(v > 0.055, !baseline_remarks(kept.r).empty() && v != 0.05) << v;
    (void)kept.accept_all();
  }
}

TEST(Baselines, CostIsJudgedOnCountsAtTheSameSeedAndNeverOnSeconds) {
  Kept kept;
  (void)kept.accept_all();
  engine(kept.r).runs[0].cost.cpu_s = 1e6;
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
  engine(kept.r).runs[0].cost.pairs = 1009.0;  // within 1 %
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
  engine(kept.r).runs[0].cost.pairs = 1020.0;
  EXPECT_EQ(baseline_remarks(kept.r).at(0).code, exit_cost);
  kept.r.seed = 2;
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
}

TEST(Baselines, WhatIsNotGreenOrHasNoReasonIsNotAccepted) {
  Kept kept;
  EXPECT_THROW((void)accept(kept.r, {}, {"2026-11-21", "abc", " "}), InputError);
  EXPECT_THROW((void)accept(kept.r, {"test/two"}, {"2026-11-21", "abc", "why"}), InputError);
  error(kept.r).value = 1.0;
  judge(kept.r);
  EXPECT_THROW((void)kept.accept_all(), InputError);
  EXPECT_FALSE(std::filesystem::exists(kept.folder / "baselines/test/one.toml"));
}

}  // namespace
}  // namespace tripoint
