// SPDX-License-Identifier: BSD-3-Clause
// Accepted figures at the edges: how far a value, a cost and a limit may move, and the words that are said
// beyond.
#include <gtest/gtest.h>

#include <cmath>

#include "fakes.hpp"
#include "judged.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/judge/remarks.hpp"

namespace tripoint {
namespace {

/// A case with a file of its own below cases/test, and a folder of baselines beside it.
struct Kept {
  TestFolder folder;
  Results r = green();
  Baseline b;
  Kept() {
    r.cases[0].file = folder / "cases/test/one.toml";
    write_text(r.cases[0].file, "no case");
    r.cases[0].gates[0].place = {r.cases[0].file, 7, 3};
    engine(r).runs[0].cost.pairs = 1000.0;
    engine(r).runs[0].cost.steps = 200.0;
    judge(r);
    b = accepted_from(r.cases[0], r.tool, r.seed, nullptr, {"2026-01-01", "abc", "it is so"});
  }
  std::vector<Remark> remarks() {
    judge(r);
    write_text(baseline_file(r.cases[0].file), baseline_text(b));
    return baseline_remarks(r);
  }
};

TEST(BaselineEdges, LooseningsAddUpAsLogarithms) {
  Kept k;
  ASSERT_EQ(k.b.gates.size(), 1u);
  for (const auto& [before, now, earlier, sum] :
       {std::tuple{0.05, 0.1, 0.25, 0.25 + std::log(2.0)}, std::tuple{0.1, 0.1, 0.25, 0.25},
        std::tuple{0.2, 0.1, 0.25, 0.25}, std::tuple{0.0, 0.1, 0.25, 0.25},
        std::tuple{0.05, 0.1, 0.0, std::log(2.0)}}) {
    auto old = k.b;
    old.gates[0].room = before;
    old.gates[0].loosened = earlier;
    old.gates[0].first_room = 0.025;
    old.gates[0].first_value = 0.03;
    k.r.cases[0].gates[0].limit = now;
    const auto b = accepted_from(k.r.cases[0], k.r.tool, 1, &old, {"", "", "why"});
    EXPECT_NEAR(b.gates.at(0).loosened, sum, 1e-12) << before;
    EXPECT_EQ(b.gates[0].first_room, 0.025);
    EXPECT_EQ(b.gates[0].first_value, 0.03);
    EXPECT_EQ(b.accepted.size(), 2u);
  }
  EXPECT_EQ(k.b.gates[0].first_room, 0.1);
  EXPECT_EQ(k.b.gates[0].first_value, 0.05);
  EXPECT_EQ(k.b.gates[0].loosened, 0.0);
}

TEST(BaselineEdges, ACostMayGrowByOneInAHundred) {
  for (const auto& [pairs, steps, says] :
       {std::tuple{1000.0, 200.0, ""}, std::tuple{1009.0, 201.0, ""},
        std::tuple{1011.0, 200.0, "1011 pairs, accepted were 1000 (+1.1 %)"},
        std::tuple{1000.0, 203.0, "203 steps, accepted were 200 (+1.5 %)"}, std::tuple{500.0, 100.0, ""},
        std::tuple{0.0, 200.0, ""}}) {
    Kept k;
    engine(k.r).runs[0].cost.pairs = pairs;
    engine(k.r).runs[0].cost.steps = steps;
    const auto list = k.remarks();
    ASSERT_EQ(list.size(), *says ? 1u : 0u) << says << remarks_text(list);
    if (!*says) continue;
    EXPECT_EQ(list[0].text, says);
    EXPECT_EQ(list[0].code, exit_cost);
    EXPECT_TRUE(list[0].error);
    EXPECT_EQ(list[0].place.line, 1);
    EXPECT_NEAR(list[0].excess, std::max(pairs / 1000.0, steps / 200.0), 1e-12);
  }
  Kept other_seed;
  engine(other_seed.r).runs[0].cost.pairs = 2000.0;
  other_seed.r.seed = other_seed.b.seed + 1;
  EXPECT_TRUE(other_seed.remarks().empty());
}

TEST(BaselineEdges, AValueMayMoveByATenthOrByItsDrift) {
  struct Row {
    double now, u;
    std::optional<double> drift;
    double first;
    std::string says;
  };
  for (const Row& row :
       {Row{0.055, 0.0, {}, 0.05, ""},
        Row{0.0551,
            0.0,
            {},
            0.05,
            "0.0551 is worse than the accepted value 0.05: it uses 0.551 of the limit, then 0.5"},
        // The judged run has no word in its own noise.
        Row{0.0551,
            0.0001,
            {},
            0.05,
            "0.0551 is worse than the accepted value 0.05: it uses 0.551 of the limit, then 0.5"},
        Row{-0.0551,
            0.0,
            {},
            0.05,
            "-0.0551 is worse than the accepted value 0.05: it uses 0.551 of the limit, then 0.5"},
        Row{0.04, 0.0, {}, 0.05, ""},
        Row{0.052,
            0.0,
            {},
            0.04,
            "0.052 is worse than the first value 0.04: it uses 0.52 of the limit, then 0.4"},
        Row{0.0509, 0.0, 0.02, 0.01, ""},
        Row{0.0511, 0.0, 0.02, 0.05,
            "0.0511 has moved from the accepted value 0.05 by more than the share of 0.02 that the gate "
            "allows"},
        Row{0.0489, 0.0, 0.02, 0.05,
            "0.0489 has moved from the accepted value 0.05 by more than the share of 0.02 that the gate "
            "allows"},
        Row{0.0511, 0.0001, 0.02, 0.05,
            "0.0511 has moved from the accepted value 0.05 by more than the share of 0.02 that the gate "
            "allows"}}) {
    Kept k;
    k.b.gates[0].first_value = row.first;
    k.b.gates[0].drift = row.drift;
    k.r.cases[0].gates[0].drift = row.drift;
    error(k.r) = value(row.now, row.u);
    const auto list = k.remarks();
    ASSERT_EQ(list.size(), row.says.empty() ? 0u : 1u) << row.now << " " << remarks_text(list);
    if (row.says.empty()) continue;
    EXPECT_EQ(list[0].text, row.says);
    EXPECT_EQ(list[0].error, row.drift.has_value());
    EXPECT_EQ(list[0].code, row.drift ? exit_fail : 0);
    EXPECT_EQ(list[0].place.line, 7);
    // The limit is 0.1
    EXPECT_NEAR(list[0].excess, row.drift ? std::abs(row.now) / 0.05 : std::abs(row.now) / 0.1, 1e-12);
  }
}

TEST(BaselineEdges, EachRemarkOnAFilePointsAtItsFirstLine) {
  Kept k;
  write_text(baseline_file(k.r.cases[0].file), baseline_text(k.b));
  std::filesystem::remove(k.r.cases[0].file);
  const auto gone = lost_case_remarks(k.r);
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0].place.line, 1);
  EXPECT_EQ(gone[0].place.file, baseline_file(k.r.cases[0].file));
  EXPECT_EQ(gone[0].code, exit_missing);
  EXPECT_EQ(gone[0].excess, infinity);
  EXPECT_NE(gone[0].text.find("has a baseline of 1 gates, and its case "), std::string::npos);
  write_text(k.r.cases[0].file, "no case");
  const auto unread = lost_case_remarks(k.r);
  ASSERT_EQ(unread.size(), 1u);
  EXPECT_NE(unread[0].text.find("its case cannot be read"), std::string::npos);
  k.b.gates.push_back(k.b.gates[0]);
  k.b.gates[1].metric = "other";
  const auto list = k.remarks();
  ASSERT_EQ(list.size(), 1u) << remarks_text(list);
  EXPECT_EQ(list[0].word, "GONE");
  EXPECT_EQ(list[0].place.line, 1);
  EXPECT_EQ(list[0].text.rfind("was accepted with limit 0.1 and judges nothing any more", 0), 0u);
  std::filesystem::remove(baseline_file(k.r.cases[0].file));
  const auto none = baseline_remarks(k.r, true);
  ASSERT_EQ(none.size(), 1u);
  EXPECT_EQ(none[0].place.line, 1);
  EXPECT_EQ(none[0].code, exit_missing);
  EXPECT_EQ(none[0].excess, infinity);
}

TEST(BaselineEdges, ABaselineOfAnOlderVersionWarnsOfAnotherText) {
  Kept k;
  k.b.scene.clear();
  EXPECT_EQ(remarks_text(k.remarks()), "");
  k.b.case_hash = "of another text";
  const auto list = k.remarks();
  ASSERT_EQ(list.size(), 1u) << remarks_text(list);
  EXPECT_EQ(list[0].text, "the case file has changed since its figures were accepted");
  EXPECT_FALSE(list[0].error);
}

TEST(BaselineEdges, AnEdgeOfWordsIsFoundWhereverItStands) {
  const auto words = [](const std::string& allows) {
    AcceptedGate g;
    g.allows = allows;
    return g;
  };
  EXPECT_EQ(looser_edge(words("at least 0.5, limit 3"), words("at least 0.5, limit 2")),
            "its upper edge has moved from 2 to 3");
  EXPECT_EQ(looser_edge(words("limit 3, at least 0.25"), words("limit 3, at least 0.5")),
            "its lower edge has moved from 0.5 to 0.25");
  EXPECT_EQ(looser_edge(words("limit 3"), words("limit 3, band 0.5 to 2")),
            "its upper edge has moved from 2 to 3");
  EXPECT_EQ(looser_edge(words("no limit"), words("limit 3")), "its upper edge, 3, is gone");
}

}  // namespace
}  // namespace tripoint
