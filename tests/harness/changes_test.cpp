// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/changes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/judged.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/publish/comment.hpp"

namespace tripoint {
namespace {

/// One judged metric `error`, limit 0.1, in runs of these seeds (one: a single run).
Results measured_as(const std::vector<double>& values, double limit_of_error = 0.1) {
  auto r = green();
  r.cases[0].gates = {limit("error", limit_of_error)};
  r.cases[0].metrics[0].unit = "m";
  engine(r).runs.clear();
  for (const double v : values) engine(r).runs.push_back(run_with({{"error", value(v)}}));
  judge(r);
  return r;
}

const MetricChange& only(const Comparison& all) {
  EXPECT_EQ(all.changes.size(), 1U);
  return all.changes.front();
}

TEST(Changes, AreInUnitsOfTheLimitAndAboveZeroIsWorse) {
  auto c = only(compare_results(measured_as({0.02}), measured_as({0.05}), "base"));
  EXPECT_EQ(c.trend, Trend::worse);
  EXPECT_NEAR(c.change, 0.3, 1e-12);  // 0.03 of 0.1
  EXPECT_EQ(values_text(c), "0.02 -> 0.05 m");
  EXPECT_EQ(used_text(c), "0.2 -> 0.5");
  EXPECT_EQ(noise_text(c), "none known");
  c = only(compare_results(measured_as({0.05}), measured_as({-0.02}), "base"));  // a limit is of the size
  EXPECT_EQ(c.trend, Trend::better);
  EXPECT_NEAR(c.change, -0.3, 1e-12);
  c = only(compare_results(measured_as({0.05}), measured_as({0.05001}), "base"));  // 1e-4 of the limit
  EXPECT_EQ(c.trend, Trend::same);
}

TEST(Changes, WhatABandAndALeastValueUseRisesTowardsTheirEdges) {
  Gate g;
  g.band = {0.9, 1.3};
  EXPECT_NEAR(share_of_limit(g, 1.1), 0.0, 1e-12);
  EXPECT_NEAR(share_of_limit(g, 1.3), 1.0, 1e-12);
  EXPECT_NEAR(share_of_limit(g, 0.8), 1.5, 1e-12);
  g = {};
  g.at_least = 2.0;
  EXPECT_NEAR(share_of_limit(g, 2.0), 1.0, 1e-12);
  EXPECT_NEAR(share_of_limit(g, 1.0), 1.5, 1e-12);
  EXPECT_NEAR(share_of_limit(g, 4.0), 0.5, 1e-12);
  g = limit("error", 0.0);
  // a limit of nothing leaves no room: beyond it the metric's own unit counts
  EXPECT_NEAR(share_of_limit(g, -2.0), 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(share_of_limit({}, 1.0)));
  EXPECT_TRUE(std::isnan(share_of_limit(g, std::nan(""))));
}

TEST(Changes, ABandAroundZeroIsBestAtZeroWhereverItsMiddleLies) {
  Gate g;
  g.band = {-0.25, 0.05};  // the front of the dam break: its true place is 0
  EXPECT_EQ(share_of_limit(g, 0.0), 0.0);
  EXPECT_NEAR(share_of_limit(g, 0.05), 1.0, 1e-12);
  EXPECT_NEAR(share_of_limit(g, -0.25), 1.0, 1e-12);
  EXPECT_NEAR(share_of_limit(g, -0.1), 0.4, 1e-12);
  auto before = measured_as({-0.1}), now = measured_as({0.0});
  for (auto* r : {&before, &now}) {
    r->cases[0].gates[0].limit.reset();
    r->cases[0].gates[0].band = g.band;
    judge(*r);
  }
  EXPECT_EQ(only(compare_results(before, now, "base")).trend, Trend::better);
}

TEST(Changes, ShareIsOneAtEachEdgeThatTheVerdictKnows) {
  for (const auto& [low, high] :
       {std::pair{-0.2, 0.5}, std::pair{0.2, 0.5}, std::pair{-0.5, -0.2}, std::pair{0.0, 0.5}}) {
    Gate g;
    g.band = {low, high};
    for (double v = -1.0; v <= 1.0; v += 0.001) {
      const double used = share_of_limit(g, v);
      if (std::abs(used - 1.0) <= 1e-9) continue;
      EXPECT_EQ(used < 1.0, verdict_of(g, v, 0.0) == Verdict::pass) << low << " " << high << " " << v;
    }
  }
}

TEST(Changes, TheJudgedRunHasNoWordInItsOwnNoise) {
  const auto with = [](double v, double stated) {
    auto r = measured_as({v}, 0.01);
    engine(r).runs[0].metrics.at("error").uncertainty.statistical = stated;
    judge(r);
    return r;
  };
  EXPECT_EQ(only(compare_results(with(0.0, 0.0), with(0.003, 0.0), "base")).trend, Trend::worse);
  EXPECT_EQ(only(compare_results(with(0.0, 0.0), with(0.003, 0.003), "base")).trend, Trend::worse);
}

/// One run with the limit 0.01 and a stated standard error.
Results stated_as(double v, double stated) {
  auto r = measured_as({v}, 0.01);
  engine(r).runs[0].metrics.at("error").uncertainty.statistical = stated;
  judge(r);
  return r;
}

TEST(Changes, AStatedErrorOfTheBaseCountsAsFarAsASecondRunBearsItOut) {
  const auto base = stated_as(0.001, 0.003), head = stated_as(0.004, 0.003);
  EXPECT_EQ(only(compare_results(base, head, "base")).trend, Trend::worse) << "nobody has measured it";
  const auto same = base, nearly = stated_as(0.00101, 0.003), other = stated_as(0.0035, 0.003);
  EXPECT_EQ(only(compare_results(base, head, "base", &same)).trend, Trend::worse);
  EXPECT_EQ(only(compare_results(base, head, "base", &nearly)).trend, Trend::worse);
  const auto c = only(compare_results(base, head, "base", &other));
  EXPECT_EQ(c.trend, Trend::same);
  EXPECT_NEAR(c.noise, 2.0 * std::sqrt(2.0) * 0.3, 1e-12);
  EXPECT_EQ(c.noise_from, "A/A");
}

TEST(Changes, StatedErrorsOfSeedsAreNotTheirScatter) {
  auto base = measured_as({0.03, 0.03, 0.03}), head = measured_as({0.05, 0.05, 0.05});
  for (auto* r : {&base, &head}) {
    for (auto& run : engine(*r).runs) run.metrics.at("error").uncertainty.statistical = 0.1;
    judge(*r);
  }
  EXPECT_EQ(only(compare_results(base, head, "base")).trend, Trend::worse);
}

TEST(Changes, AScatterThatAppearsIsWorseThoughTheMeanStays) {
  const auto base = measured_as({0.04, 0.04, 0.04}), head = measured_as({0.01, 0.04, 0.07});
  const auto c = only(compare_results(base, head, "base"));
  EXPECT_EQ(c.trend, Trend::worse);
  EXPECT_EQ(c.noise_from, "none known, now 0.49");
  EXPECT_EQ(only(compare_results(head, base, "base")).trend, Trend::same);
}

TEST(Changes, ManySeedsOfTheJudgedRunHideNothingEither) {
  const auto c = only(compare_results(measured_as({0.02}), measured_as({0.01, 0.05, 0.09}), "base"));
  EXPECT_EQ(c.trend, Trend::worse);
  EXPECT_EQ(c.noise_from, "none known");
}

TEST(Changes, WithinTheScatterOfSeedsNothingHasChanged) {
  // Deviation 0.01, of a mean 0.0058
  const auto base = measured_as({0.03, 0.04, 0.05}), head = measured_as({0.04, 0.05, 0.06});
  auto c = only(compare_results(base, head, "base"));
  EXPECT_NEAR(c.change, 0.1, 1e-12);
  EXPECT_NEAR(c.noise, 2.0 * std::sqrt(2.0) * 0.01 / std::sqrt(3.0) / 0.1, 1e-9);
  EXPECT_EQ(c.noise_from, "3 seeds");
  EXPECT_EQ(c.trend, Trend::same);
  c = only(compare_results(base, measured_as({0.06, 0.07, 0.08}), "base"));
  EXPECT_EQ(c.trend, Trend::worse);
}

TEST(Changes, WhatTheSameCodeDiffersByIsNoiseToo) {
  const auto base = measured_as({0.02}), head = measured_as({0.05}), again = measured_as({0.055});
  const auto c = only(compare_results(base, head, "base", &again));
  EXPECT_EQ(c.trend, Trend::same);
  EXPECT_NEAR(c.noise, 0.35, 1e-12);
  EXPECT_EQ(c.noise_from, "A/A");
}

TEST(Changes, WithinALimitOfRoundOffNothingHasChanged) {
  auto c = only(compare_results(measured_as({1e-13}, 1e-10), measured_as({7e-11}, 1e-10), "base"));
  EXPECT_EQ(c.trend, Trend::same);
  EXPECT_EQ(c.noise_from, "round-off");
  c = only(compare_results(measured_as({1e-13}, 1e-10), measured_as({5e-10}, 1e-10), "base"));
  EXPECT_EQ(c.trend, Trend::worse);
}

TEST(Changes, ALimitThatIsLoosenedHidesNothing) {
  const auto all = compare_results(measured_as({0.05}), measured_as({0.15}, 0.3), "base");
  EXPECT_NEAR(only(all).change, 1.0, 1e-12);  // of the limit that was there
  EXPECT_TRUE(only(all).looser);
  const auto said = change_remarks(all, false), strict = change_remarks(all, true);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_FALSE(said[0].error || said[1].error);
  EXPECT_EQ(strict[0].code, exit_fail);
  EXPECT_EQ(strict[1].code, exit_missing);
  EXPECT_EQ(strict[1].word, "LOOSENED");
}

TEST(Changes, WorseWithinTheLimitIsSaidAndRedOnlyWhenAsked) {
  const auto all = compare_results(measured_as({0.02}), measured_as({0.05}), "base");
  ASSERT_EQ(change_remarks(all, false).size(), 1U);
  EXPECT_FALSE(change_remarks(all, false)[0].error);
  EXPECT_TRUE(change_remarks(all, true)[0].error);
  EXPECT_NE(change_remarks(all, false)[0].text.find("+0.3"), std::string::npos);
  EXPECT_TRUE(
      change_remarks(compare_results(measured_as({0.05}), measured_as({0.02}), "base"), true).empty());
  EXPECT_TRUE(change_remarks(compare_results(measured_as({0.05}), measured_as({0.5}), "base"), false).empty())
      << "a red gate is the judge's";
}

TEST(Changes, NameWhatIsNewAndWhatIsGone) {
  auto base = measured_as({0.05}), head = base;
  head.cases[0].gates = {limit("speed", 1.0)};
  head.cases[0].engines[0].runs[0].metrics = {{"speed", value(0.5)}};
  judge(head);
  const auto all = compare_results(base, head, "base");
  EXPECT_EQ(counts_text(all), "0 better, 0 worse, 0 unchanged, 1 new, 1 gone");
  const auto strict = change_remarks(all, true);
  ASSERT_EQ(strict.size(), 1U);
  EXPECT_EQ(strict[0].word, "GONE");
}

TEST(Changes, ShowMetricsThatNoGateJudgesToo) {
  auto base = measured_as({0.05}), head = base;
  base.cases[0].engines[0].runs[0].metrics["mass"] = value(2.0);
  head.cases[0].engines[0].runs[0].metrics["mass"] = value(2.5);
  const auto all = compare_results(base, head, "base");
  ASSERT_EQ(all.changes.size(), 2U);
  EXPECT_NEAR(all.changes[1].change, 0.25, 1e-12);
  EXPECT_EQ(all.changes[1].trend, Trend::same);  // without a limit nobody can say better or worse
  EXPECT_NE(changes_table(all).find("mass: 2 -> 2.5, - -> - of no limit"), std::string::npos)
      << changes_table(all);
}

TEST(Changes, AValueThatIsNoneAnyMoreIsWorseThanAny) {
  const auto all = compare_results(measured_as({0.05}), measured_as({std::nan("")}), "base");
  EXPECT_EQ(only(all).trend, Trend::worse);
  EXPECT_EQ(change_text(only(all)), "+inf");
}

GateVerdict verdict_of(const Results& r) {
  GateVerdict v;
  add_remarks(v, r, verdict_remarks(r));
  return v;
}

TEST(Comment, BeginsWithItsMarkAndHoldsTheTenMostChanged) {
  auto base = measured_as({0.05}), head = base;
  for (auto* r : {&base, &head}) {
    r->cases[0].gates.clear();
    for (int k = 0; k < 15; ++k) {
      r->cases[0].gates.push_back(limit("m" + std::to_string(k), 1.0));
      r->cases[0].engines[0].runs[0].metrics["m" + std::to_string(k)] =
          value(r == &base ? 0.1 : 0.1 + 0.01 * k);
    }
    judge(*r);
  }
  const auto all = compare_results(base, head, "base");
  const auto text = comment_markdown(head, verdict_of(head), &all, {});
  EXPECT_TRUE(text.starts_with("<!-- tripoint: accuracy -->\n## Accuracy: PASS\n")) << text;
  EXPECT_NE(text.find("| **worse** | +0.14 | test/one | tripoint m14 | 0.1 -> 0.24 | 0.1 -> 0.24 of limit 1 "
                      "| none known |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("m5 "), std::string::npos);
  EXPECT_EQ(text.find("m4 "), std::string::npos) << "the eleventh";
}

TEST(Comment, LinksCaseFilesWithTheirLine) {
  auto base = measured_as({0.02}), head = measured_as({0.05});
  head.cases[0].gates[0].place = {"cases/a b.toml", 12, 0};
  judge(head);
  CommentOptions o;
  o.links = "https://host/o/p/blob/abc";
  const auto all = compare_results(base, head, "base");
  EXPECT_NE(comment_markdown(head, verdict_of(head), &all, o)
                .find("[test/one](https://host/o/p/blob/abc/cases/a%20b.toml#L12)"),
            std::string::npos);
  head.cases[0].gates[0].place = {"../../etc/passwd", 12, 0};
  judge(head);
  EXPECT_EQ(comment_markdown(head, verdict_of(head), &all, o).find("passwd"), std::string::npos);
}

TEST(Dashboard, HoldsEachJudgedMetricWithUnitAndRange) {
  const auto data = nlohmann::json::parse(dashboard_json(measured_as({0.03, 0.04, 0.05}), false));
  ASSERT_EQ(data.size(), 1U);
  EXPECT_EQ(data[0]["name"], "test/one tripoint error");
  EXPECT_EQ(data[0]["unit"], "m");
  EXPECT_NEAR(data[0]["value"].get<double>(), 0.04, 1e-12);
  EXPECT_EQ(data[0]["range"], "\u00b1 0.0115");  // two standard uncertainties of the mean
  const auto shares = nlohmann::json::parse(dashboard_json(measured_as({0.03, 0.04, 0.05}), true));
  EXPECT_NEAR(shares[0]["value"].get<double>(), 0.4, 1e-12);
  EXPECT_EQ(shares[0]["range"], "\u00b1 0.115");
}

TEST(Badge, IsGreenOnlyWhereTheVerdictIsPass) {
  const auto good = measured_as({0.05}), bad = measured_as({0.5});
  EXPECT_NE(badge_text(good, verdict_of(good), true).find("1/1 gates"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(badge_text(good, verdict_of(good), true))["schemaVersion"], 1);
  EXPECT_NE(badge_text(bad, verdict_of(bad), false).find("FAIL, 0/1 gates"), std::string::npos);
  EXPECT_NE(badge_text(bad, verdict_of(bad), false).find("#c62828"), std::string::npos);
}

TEST(Sarif, HasAResultForEachRemarkAtItsLine) {
  auto bad = measured_as({0.5});
  bad.cases[0].gates[0].place = {"cases/x.toml", 9, 0};
  judge(bad);
  const auto run = nlohmann::json::parse(sarif_text(verdict_of(bad)))["runs"][0];
  ASSERT_EQ(run["results"].size(), 1U);
  EXPECT_EQ(run["results"][0]["ruleId"], "FAIL");
  EXPECT_EQ(run["results"][0]["locations"][0]["physicalLocation"]["region"]["startLine"], 9);
}

}  // namespace
}  // namespace tripoint
