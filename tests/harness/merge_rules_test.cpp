// SPDX-License-Identifier: BSD-3-Clause
// What a change may not do to the suite that judges it, from results made by hand.
// tests/cli/merge_walk_test.py walks the same with git and an engine.
#include <gtest/gtest.h>

#include "fakes.hpp"
#include "judged.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/case/dates.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/judge/remarks.hpp"
#include "validation/run/finished_run.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

AcceptedGate band(double low, double high) {
  AcceptedGate g;
  g.band = std::array{low, high};
  return g;
}

AcceptedGate ceiling(double most) {
  AcceptedGate g;
  g.limit = most;
  return g;
}

TEST(MergeRules, ABandMayMoveTowardTheTruthAndNoOtherWay) {
  EXPECT_TRUE(is_nearer_truth(band(0.01, 0.02), band(0.02, 0.04)));
  EXPECT_TRUE(is_nearer_truth(band(-0.02, -0.01), band(-0.04, -0.02)));
  EXPECT_TRUE(is_nearer_truth(ceiling(1e-10), band(0.02, 0.04)));
  EXPECT_FALSE(is_nearer_truth(band(0.0, 0.04), band(0.02, 0.04))) << "wider";
  EXPECT_FALSE(is_nearer_truth(band(0.03, 0.045), band(0.02, 0.04))) << "its upper edge allows more";
  EXPECT_FALSE(is_nearer_truth(band(-0.03, -0.02), band(0.02, 0.04)))
      << "an error of the other sign as large";
  EXPECT_FALSE(is_nearer_truth(band(0.01, 0.02), band(-0.02, 0.04))) << "a band about zero has no side";
  EXPECT_FALSE(is_nearer_truth(ceiling(0.01), ceiling(0.02))) << "a limit is compared by its edges alone";
}

TEST(MergeRules, ADateIsADayThatHasBeen) {
  for (const char* day : {"2026-11-22", "2024-02-29"}) EXPECT_TRUE(is_date(day)) << day;
  for (const char* word : {"tomorrow", "2026-11-31", "2025-02-29", "2026-1-2", "22.11.2026",
                           "2026-11-22T00:00", "2026-11-2x", ""})
    EXPECT_FALSE(is_date(word)) << word;
  EXPECT_FALSE(is_in_the_future("2020-01-01"));
  EXPECT_TRUE(is_in_the_future("9999-12-31"));
}

TEST(MergeRules, ADateToComeSilencesNothing) {
  auto r = green();
  error(r).value = 0.001;
  r.cases[0].gates[0].date = "9999-12-31";
  judge(r);
  EXPECT_TRUE(headroom_remarks(r).at(0).error);
}

TEST(MergeRules, AWideLimitIsNotLooseWhereAnotherGateHoldsTheValue) {
  auto r = green();
  error(r).value = 0.001;
  auto tight = limit("error", 0.0015);
  tight.place.line = 9;
  r.cases[0].gates.push_back(tight);
  judge(r);
  EXPECT_TRUE(headroom_remarks(r).empty());
  r.cases[0].gates[1].limit = 0.05;
  judge(r);
  EXPECT_EQ(headroom_remarks(r).size(), 2u);
}

/// A case with a file below cases/test, a third-party engine, and what was accepted of both.
struct Adopted {
  TestFolder folder;
  Results r = green();
  Adopted() {
    r.cases[0].file = folder / "cases/test/one.toml";
    write_text(r.cases[0].file, "no case");
    write_text(folder / "engine-stone", "the program");
    auto& e = engine(r);
    e.name = "stone";
    e.version = "1.10";
    e.executable = folder / "engine-stone";
    e.executable_hash = file_hash(e.executable);
    e.deterministic = true;
    judge(r);
    keep(folder / "cases/../baselines");
  }
  void keep(const std::string& root) {
    write_text(
        baseline_file(r.cases[0].file, root),
        baseline_text(accepted_from(r.cases[0], r.tool, r.seed, nullptr, {"2026-01-01", "abc", "it is so"})));
  }
  std::vector<Remark> engines() {
    judge(r);
    return engine_remarks(r);
  }
};

TEST(MergeRules, AVersionThatFallsIsNamed) {
  for (const auto& [now, falls] :
       {std::pair{"1.9", true}, std::pair{"1.10.0", false}, std::pair{"1.11", false},
        std::pair{"0.99.9", true}, std::pair{"22 Jul 2025", false}, std::pair{"v1.2", true}}) {
    Adopted a;
    engine(a.r).version = now;
    const auto list = a.engines();
    ASSERT_EQ(list.size(), falls ? 1u : 0u) << now;
    for (const auto& r : list)
      EXPECT_NE(r.text.find("has fallen from 1.10, which was accepted, to"), std::string::npos) << r.text;
  }
}

TEST(MergeRules, AReportOlderThanItsEngineIsNotOfIt) {
  Adopted a;
  EXPECT_TRUE(a.engines().empty());
  write_text(engine(a.r).executable, "another program");
  // The hash of a program is read once a call: this one is new to us.
  const auto other = a.folder / "engine-other";
  write_text(other, "another program");
  engine(a.r).executable = other;
  const auto list = a.engines();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_TRUE(list[0].error);
  EXPECT_EQ(list[0].word, "CHANGED");
}

TEST(MergeRules, ACaseThatIsRenamedInPlaceIsSeen) {
  Adopted a;
  a.r.cases[0].id = "test/other";
  a.r.planned = {"test/other"};
  judge(a.r);
  const auto list = baseline_remarks(a.r);
  ASSERT_FALSE(list.empty());
  EXPECT_NE(list[0].text.find("its id was test/one when its figures were accepted"), std::string::npos)
      << list[0].text;
}

TEST(MergeRules, ABaselineThatIsGoneHereAndNotThereIsRed) {
  Adopted a;
  const auto there = a.folder / "target/baselines";
  a.keep(there);
  EXPECT_TRUE(suite_remarks(a.r, true, there).empty());
  fs::remove(baseline_file(a.r.cases[0].file));
  const auto list = suite_remarks(a.r, true, there);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].word, "GONE");
}

TEST(MergeRules, LinksAreNamedWhereverTheyStand) {
  for (const char* link : {"cases/test/two.toml", "cases/more", "baselines/test/two.toml"}) {
    Adopted a;
    EXPECT_TRUE(suite_remarks(a.r, false).empty());
    fs::create_symlink(a.folder / "cases/test/one.toml", a.folder / link);
    const auto list = suite_remarks(a.r, false);
    ASSERT_EQ(list.size(), 1u) << link;
    EXPECT_NE(list[0].text.find("is a link"), std::string::npos);
  }
}

TEST(MergeRules, AnAdoptedEngineIsNotLeftOut) {
  auto r = green();
  r.cases[0].adopted = {"stone"};
  EXPECT_EQ(exit_of(r), exit_missing);
  engine(r).name = "stone";
  EXPECT_EQ(exit_of(r), exit_pass);
}

}  // namespace
}  // namespace tripoint
