// SPDX-License-Identifier: BSD-3-Clause
// Accuracy by release, on results made by hand.
#include "validation/publish/releases.hpp"
#include "validation/case/case.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tripoint {
namespace {

Release release(const std::string& version, double error, double order, Verdict gate_verdict = Verdict::pass,
                const std::string& build = "double precision") {
  Release r;
  r.engine.name = "stone";
  r.engine.version = version;
  r.engine.build = build;
  EngineRow e;
  e.name = "stone";
  e.version = version;
  e.preset = "RK4";
  RunRow run;
  run.base = true;
  run.metrics["angle"].value = error;
  e.runs.push_back(run);
  OrderRow fit;
  fit.metric = "angle";
  fit.axes = {Axis::time_step};
  fit.order.value = order;
  fit.step = {0.02, 0.01};
  fit.error = {4 * error, error};
  e.order.push_back(fit);
  GateRow gate;
  gate.metric = "angle";
  gate.verdict = gate_verdict;
  gate.why = "0.2 is above limit 0.1";
  e.gates.push_back(gate);
  r.result.engines.push_back(e);
  MetricChoice angle;
  angle.name = "angle";
  angle.unit = "rad";
  r.result.metrics.push_back(angle);
  return r;
}

ReleaseTable table(std::vector<Release> releases) {
  return {"rigid/top", "A top", "tripoint releases stone", 1.5, std::move(releases)};
}

TEST(Releases, AChangeNamesErrorOrderAndDirection) {
  const auto found = changes_between(release("1", 2.2e-4, 2.0), release("2", 6.5e-9, 4.0), 1.5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].worse);
  EXPECT_NEAR(found[0].ratio, 2.2e-4 / 6.5e-9, 1.0);
  EXPECT_EQ(found[0].order_before, 2.0);
  EXPECT_EQ(found[0].order_after, 4.0);
  EXPECT_TRUE(changes_between(release("2", 6.5e-9, 4.0), release("3", 2.2e-4, 2.0), 1.5).at(0).worse);
}

TEST(Releases, WithinTheMarginAndWithinRoundOffNothingChanged) {
  EXPECT_TRUE(changes_between(release("1", 1.0e-3, 2.0), release("2", 1.49e-3, 2.0), 1.5).empty());
  EXPECT_EQ(changes_between(release("1", 1.0e-3, 2.0), release("2", 1.51e-3, 2.0), 1.5).size(), 1U);
  EXPECT_TRUE(changes_between(release("1", 1e-16, 2.0), release("2", 9e-12, 2.0), 1.5).empty());
  EXPECT_EQ(changes_between(release("1", 1e-7, 1.0), release("2", 8e-6, 1.0), 1.5).size(), 1U);
  EXPECT_TRUE(changes_between(release("1", 1e-7, 1.0, Verdict::pass, "single precision"),
                              release("2", 8e-6, 1.0, Verdict::pass, "single precision"), 1.5)
                  .empty());
}

TEST(Releases, AMetricAgainstAnotherSchemeIsNoError) {
  auto from = release("1", 1e-3, 1.0), to = release("2", 1.0, 1.0);
  to.result.metrics[0].reference.emplace().kind = ReferenceKind::discrete_exact;
  EXPECT_TRUE(changes_between(from, to, 1.5).empty());
}

TEST(Releases, AnErrorThatIsNoLongerFiniteIsWorse) {
  const auto found = changes_between(release("1", 1e-3, 1.0),
                                     release("2", std::numeric_limits<double>::quiet_NaN(), 1.0), 1.5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].worse);
}

TEST(Releases, TheLastIsComparedWithTheFirst) {
  EXPECT_TRUE(is_worse(table({release("1", 1e-3, 1.0), release("2", 1e-6, 2.0), release("3", 2e-3, 1.0)})));
  EXPECT_FALSE(is_worse(table({release("1", 1e-3, 1.0), release("2", 5e-1, 0.0), release("3", 1e-3, 1.0)})));
  EXPECT_TRUE(is_worse(table({release("1", 1e-3, 1.0), release("2", 1e-3, 1.0, Verdict::fail)})))
      << "a gate turned red";
  EXPECT_FALSE(
      is_worse(table({release("1", 1e-3, 1.0, Verdict::fail), release("2", 1e-3, 1.0, Verdict::fail)})))
      << "it was red before";
  auto gone = table({release("1", 1e-3, 1.0), release("2", 1e-3, 1.0)});
  gone.releases[1].result.engines[0].status = Status::diverged;
  EXPECT_TRUE(is_worse(gone));
}

TEST(Releases, TheMarkdownShowsErrorAndOrderOfEachReleaseAndWhatChanged) {
  const auto text =
      releases_markdown(table({release("1", 2.2e-4, 2.0), release("2", 6.5e-9, 4.0, Verdict::fail)}));
  for (const auto* wanted : {"| stone 1 | 0.00022 (2.0 too-few) |", "| stone 2 | 6.5e-09 (4.0 too-few) |",
                             "1 -> 2, RK4 angle: 0.00022 -> 6.5e-09, 3.38e+04 times better; order 2.0 -> 4.0",
                             "| stone 2 | 0 of 1 | RK4 angle: 0.2 is above limit 0.1 |"})
    EXPECT_NE(text.find(wanted), std::string::npos) << wanted << "\n" << text;
}

TEST(Releases, TheCaseIsRunOnTheOneEngineInItsPresets) {
  Case value;
  value.scene.time_step = 0.01;
  value.engines.resize(2);
  value.engines[0].name = "tripoint";
  value.engines[0].required = true;
  value.engines[1].name = "stone";
  value.engines[1].required = true;
  value.engines[1].presets = {"RK4"};
  EngineEntry engine;
  engine.name = "stone";
  engine.presets = {"Euler", "RK4"};
  const auto own = case_for_releases(value, engine, {}, {});
  ASSERT_EQ(own.engines.size(), 1U);
  EXPECT_FALSE(own.engines[0].required);
  EXPECT_EQ(own.engines[0].presets, std::vector<std::string>{"RK4"});
  EXPECT_EQ(own.studies.at(0).levels, (std::vector<double>{0.02, 0.01, 0.005, 0.0025}));
  value.engines.pop_back();
  EXPECT_EQ(case_for_releases(value, engine, {}, {0.1, 0.05}).engines[0].presets, engine.presets);
  EXPECT_EQ(case_for_releases(value, engine, {"Euler"}, {0.1, 0.05}).studies.at(0).levels,
            (std::vector<double>{0.1, 0.05}));
}

}  // namespace
}  // namespace tripoint
