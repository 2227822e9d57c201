// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "fakes.hpp"
#include "judged.hpp"
#include "validation/campaign/accuracy_cost.hpp"

namespace tripoint {
namespace {

/// Second order in the spacing, cost of its fifth power.
CaseResult second_order() {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  for (auto& run : engine(r).runs) run.cost.cpu_s = 1e-3 * std::pow(run.knobs.spacing, -5.0) * 1e-3;
  return r.cases[0];
}

Scene unit_box() {
  Scene s;
  Body b;
  b.shape.min = {0.0, 0.0, 0.0};
  b.shape.max = {1.0, 1.0, 1.0};
  s.bodies = {b};
  return s;
}

TEST(Front, APowerLawIsPredictedOnTheLineAndBeyondIt) {
  const auto c = second_order();
  const auto ladders = ladders_of(c, "error");
  ASSERT_EQ(ladders.size(), 1u);
  for (const double h : {0.08, 0.03, 0.00625}) {
    EXPECT_NEAR(predicted_error(ladders[0], h).value, 16.0 * h * h, 1e-9);
    EXPECT_NEAR(predicted_cpu(ladders[0], h).value / (1e-6 * std::pow(h, -5.0)), 1.0, 1e-9);
    // No curvature: what seconds and lines are ever known to
    EXPECT_EQ(predicted_error(ladders[0], h).factor, 1.1);
  }
}

TEST(Front, TheRecommendedSpacingDividesTheScene) {
  const auto c = second_order();
  const auto ladders = ladders_of(c, "error");
  const auto r = cheapest_for_error(unit_box(), ladders, 5e-3);
  ASSERT_TRUE(r);
  EXPECT_NEAR(1.0 / r->level, std::round(1.0 / r->level), 1e-9);
  EXPECT_LE(r->error.value, 5e-3);
  EXPECT_GT(predicted_error(ladders[0], 1.0 / (std::round(1.0 / r->level) - 2.0)).value,
            4.7e-3);  // and is not finer than it must be
}

TEST(Front, TheCheapestOfTwoEnginesIsTaken) {
  auto c = second_order();
  c.engines.push_back(c.engines[0]);
  c.engines[1].name = "other";
  for (auto& run : c.engines[1].runs) run.cost.cpu_s *= 0.1;
  const auto ladders = ladders_of(c, "error");
  EXPECT_EQ(cheapest_for_error(unit_box(), ladders, 1e-2)->ladder->engine, "other");
}

TEST(Front, SecondsBuyTheSmallestErrorThatFits) {
  const auto c = second_order();
  const auto ladders = ladders_of(c, "error");
  const auto r = best_within(unit_box(), ladders, 1.0);
  ASSERT_TRUE(r);
  EXPECT_LE(r->cpu_s.value, 1.0);
  EXPECT_FALSE(best_within(unit_box(), ladders, 1e-9));
}

TEST(Front, WhatLiesMoreThanTwiceBeyondTheMeasuredIsNotPromised) {
  const auto c = second_order();
  EXPECT_FALSE(cheapest_for_error(unit_box(), ladders_of(c, "error"), 1e-5));
}

TEST(Front, ARunThatFailedIsNoPointOfTheFront) {
  auto c = second_order();
  c.engines[0].runs[1].status = Status::diverged;
  EXPECT_EQ(ladders_of(c, "error")[0].points.size(), 3u);
}

TEST(Uncertainty, OfTheGridCountsAgainstAnExperimentAndNotAgainstTheTruth) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  auto& c = r.cases[0];
  c.studies[0].order = 2.0;
  c.gates = {limit("error", 0.3)};
  c.reference.kind = ReferenceKind::analytic;
  judge(r);
  EXPECT_EQ(engine(r).gates.back().uncertainty, 0.0);
  c.reference.kind = ReferenceKind::experiment;
  judge(r);
  // Second order to a limit of 0
  EXPECT_NEAR(engine(r).gates.back().budget.numerical, 0.5 * 1.25 * 2.5e-3, 1e-8);
  // The finest is 2.5e-3 + 2 * 1.56e-3
  c.gates[0].limit = 3.0e-3;
  judge(r);
  EXPECT_EQ(engine(r).gates.back().verdict, Verdict::inconclusive);
}

TEST(Uncertainty, OfAnInputIsHalfOfWhatItsEndsMove) {
  auto r = green();
  for (const auto& [end, v] :
       {std::pair{"material.stuff.density=990", 0.047}, std::pair{"material.stuff.density=1010", 0.055}}) {
    auto run = run_with({{"error", value(v)}});
    run.base = false;
    run.input = end;
    run.group = end;
    engine(r).runs.push_back(run);
  }
  judge(r);
  ASSERT_EQ(engine(r).gates.size(), 1u);  // the ends themselves are not judged
  EXPECT_NEAR(engine(r).gates[0].budget.input, 0.004, 1e-15);
  EXPECT_NEAR(engine(r).gates[0].uncertainty, 0.004, 1e-15);
  engine(r).runs.back().status = Status::killed;
  engine(r).runs.back().reason = "it was";
  judge(r);
  EXPECT_NE(r.exit_code, exit_pass);  // an end that gave no value leaves the uncertainty unknown
}

TEST(Uncertainty, OfAnInputOfACaseIsMeasuredByTwoMoreRuns) {
  const TestFolder folder;
  const auto value = read_flight_case(
      folder,
      "[[input]]\nkey = \"body.cube.velocity\"\nlow = \"[0.99, 0.0, 2.0]\"\nhigh = \"[1.01, 0.0, 2.0]\"\n");
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  const auto result = run_suite({value}, {ask_engine(fake_engine(folder, "nothing"))}, options).cases.at(0);
  ASSERT_EQ(result.engines.at(0).runs.size(), 3u);
  EXPECT_EQ(result.engines[0].status, Status::ok) << result.engines[0].reason;
  // Against the truth of its own scene an input moves nothing
  EXPECT_LT(result.engines[0].gates.at(0).budget.input, 1e-12);
}

}  // namespace
}  // namespace tripoint
