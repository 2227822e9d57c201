// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "kept.hpp"

namespace tripoint {
namespace {

/// Results of two engines, accepted; then those of one of them, as without the other's program.
struct WithoutTheOther : Kept {
  WithoutTheOther() {
    r.cases[0].engines.push_back(r.cases[0].engines[0]);
    r.cases[0].engines[1].name = "other";
    r.cases[0].engines[1].runs[0].folder = "runs/test/one/other/corrected";
    r.cases[0].gates.push_back(r.cases[0].gates[0]);
    r.cases[0].gates[1].engine = "other";
    judge(r);
    (void)accept_all();
    r.cases[0].engines.pop_back();
    r.only_engines = {"tripoint"};
    judge(r);
  }
  [[nodiscard]] Baseline accepted() const { return read_baseline(folder / "baselines/test/one.toml"); }
};

TEST(Baselines, AreNotAcceptedWithoutAnEngineThatTheyHold) {
  WithoutTheOther kept;
  const auto before = baseline_text(kept.accepted());
  try {
    (void)kept.accept_all();
    FAIL() << "the rows of the other engine went without a word";
  } catch (const InputError& e) {
    const std::string said = e.what();
    for (const char* part : {"test/one: the results lack what was accepted of other (error)",
                             "--drop-missing", "--keep-missing"})
      EXPECT_NE(said.find(part), std::string::npos) << said;
  }
  EXPECT_EQ(baseline_text(kept.accepted()), before);
}

TEST(Baselines, KeepTheWholeRowsOfAnEngineThatDidNotRunOrDropThemByName) {
  WithoutTheOther kept;
  const auto before = kept.accepted();
  (void)kept.accept_all({.keep = true});
  const auto after = kept.accepted();
  EXPECT_EQ(after.gates.size(), before.gates.size());
  EXPECT_EQ(after.cost.size(), before.cost.size());
  EXPECT_EQ(after.engines.size(), before.engines.size());
  const auto said = kept.accept_all({.drop = true});
  EXPECT_NE(said.find("test/one other: REMOVED with its runs"), std::string::npos) << said;
  EXPECT_NE(said.find("error: REMOVED, it was limit 0.1"), std::string::npos) << said;
  EXPECT_EQ(kept.accepted().engines.size(), 1u);
  EXPECT_EQ(kept.accepted().cost.size(), 1u);
}

TEST(Baselines, AreNotAcceptedWhereAnAcceptedRunEndedEarlyThatNoGateJudges) {
  Kept kept;
  auto& runs = engine(kept.r).runs;
  runs.push_back(runs[0]);
  runs[1].folder = "runs/test/one/tripoint/time_step=0.5";
  (void)kept.accept_all();
  EXPECT_TRUE(baseline_remarks(kept.r).empty());
  runs[1].status = Status::killed;
  EXPECT_EQ(baseline_remarks(kept.r).at(0).word, "GONE");
  try {
    (void)kept.accept_all({.keep = true});
    FAIL() << "the run went without a word";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("tripoint (time_step=0.5: killed)"), std::string::npos) << e.what();
  }
  const auto said = kept.accept_all({.drop = true});
  EXPECT_NE(said.find("test/one tripoint/time_step=0.5: REMOVED, killed"), std::string::npos) << said;
}

TEST(Baselines, HoldNothingOfAnEngineThatNoGateJudges) {
  Kept kept;
  auto& guest = kept.r.cases[0].engines.emplace_back(kept.r.cases[0].engines[0]);
  guest.name = "guest";
  guest.required = false;
  kept.r.cases[0].gates[0].engine = "tripoint";
  guest.runs[0].folder = "runs/test/one/guest/corrected";
  judge(kept.r);
  (void)kept.accept_all();
  const auto file = read_baseline(kept.folder / "baselines/test/one.toml");
  EXPECT_EQ(file.engines.size(), 1u);
  ASSERT_EQ(file.cost.size(), 1u);
  EXPECT_EQ(file.cost[0].run, "tripoint/corrected");
}

TEST(Baselines, SayWhatElseIsAnotherWhenTheyAreAccepted) {
  Kept kept;
  const auto file = kept.folder / "cases/test/one.toml";
  const auto engines = std::string("\n[engines.tripoint]\nrequired = ");
  const auto with = [](const std::string& profiles) {
    auto text = flight_case();
    return text.replace(text.find("[case]"), 6, "[case]\nprofiles = " + profiles);
  };
  write_text(file, with(R"(["commit", "nightly"])") + engines + "true\n");
  (void)kept.accept_all();
  write_text(file, with(R"(["nightly"])") + engines + "false\n");
  kept.r.cases[0].id = "test/other";
  kept.r.seed = 7;
  auto& run = engine(kept.r).runs[0];
  run.folder = "runs/test/one/tripoint/elsewhere";
  const auto said = kept.accept_all();
  for (const char* part :
       {"RENAMED, it was test/one", "seed 1 -> 7", "LEAVES the profile commit",
        "tripoint is REQUIRED NO MORE", "tripoint/corrected: REMOVED, there is no such run"})
    EXPECT_NE(said.find(part), std::string::npos) << part << " is not in\n" << said;
}

}  // namespace
}  // namespace tripoint
