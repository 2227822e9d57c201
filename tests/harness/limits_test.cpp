// SPDX-License-Identifier: BSD-3-Clause
// A limit, a band and an order at their edges: exactly on it, one step of double precision beyond it, and
// with what is no number.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/baseline/baseline.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/metrics/order.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

const double nan = std::nan("");
double above(double x) { return std::nextafter(x, infinity); }
double below(double x) { return std::nextafter(x, -infinity); }
/// Beyond, by more than the round-off of a sum with an uncertainty.
double over(double x) { return x + 1e-12; }
double under(double x) { return x - 1e-12; }

TEST(Limits, AValueOnTheLimitPassesAndTheNextNumberFails) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(judge_limit(sign * 0.5, 0.0, 0.5), Verdict::pass);
    EXPECT_EQ(judge_limit(sign * above(0.5), 0.0, 0.5), Verdict::fail);
  }
  EXPECT_EQ(judge_limit(0.25, 0.125, 0.5), Verdict::pass);  // 0.25 + 2 x 0.125 = 0.5
  EXPECT_EQ(judge_limit(0.25, over(0.125), 0.5), Verdict::inconclusive);
  EXPECT_EQ(judge_limit(-0.75, 0.125, 0.5), Verdict::inconclusive);  // 0.75 - 2 x 0.125 = 0.5
  EXPECT_EQ(judge_limit(-over(0.75), 0.125, 0.5), Verdict::fail);
  EXPECT_EQ(judge_limit(0.75, 0.25, 1.0, 1.0), Verdict::pass);
  EXPECT_EQ(judge_limit(over(1.25), 0.25, 1.0, 1.0), Verdict::fail);
}

TEST(Limits, AtLeastIsMetByTheLeastAndNotByTheNumberBelow) {
  EXPECT_EQ(judge_at_least(0.5, 0.0, 0.5), Verdict::pass);
  EXPECT_EQ(judge_at_least(below(0.5), 0.0, 0.5), Verdict::fail);
  EXPECT_EQ(judge_at_least(-0.5, 0.0, 0.5), Verdict::fail);  // not of the size
  EXPECT_EQ(judge_at_least(0.75, 0.125, 0.5), Verdict::pass);
  EXPECT_EQ(judge_at_least(under(0.75), 0.125, 0.5), Verdict::inconclusive);
  EXPECT_EQ(judge_at_least(0.25, 0.125, 0.5), Verdict::inconclusive);
  EXPECT_EQ(judge_at_least(under(0.25), 0.125, 0.5), Verdict::fail);
}

TEST(Limits, ABandHoldsBothItsEdges) {
  EXPECT_EQ(judge_band(1.0, 0.0, 1.0, 2.0), Verdict::pass);
  EXPECT_EQ(judge_band(2.0, 0.0, 1.0, 2.0), Verdict::pass);
  EXPECT_EQ(judge_band(below(1.0), 0.0, 1.0, 2.0), Verdict::fail);
  EXPECT_EQ(judge_band(above(2.0), 0.0, 1.0, 2.0), Verdict::fail);
  EXPECT_EQ(judge_band(1.25, 0.125, 1.0, 2.0), Verdict::pass);
  EXPECT_EQ(judge_band(1.75, 0.125, 1.0, 2.0), Verdict::pass);
  EXPECT_EQ(judge_band(under(1.25), 0.125, 1.0, 2.0), Verdict::inconclusive);
  EXPECT_EQ(judge_band(over(1.75), 0.125, 1.0, 2.0), Verdict::inconclusive);
  EXPECT_EQ(judge_band(0.75, 0.125, 1.0, 2.0), Verdict::inconclusive);
  EXPECT_EQ(judge_band(2.25, 0.125, 1.0, 2.0), Verdict::inconclusive);
  EXPECT_EQ(judge_band(under(0.75), 0.125, 1.0, 2.0), Verdict::fail);
  EXPECT_EQ(judge_band(over(2.25), 0.125, 1.0, 2.0), Verdict::fail);
}

TEST(Limits, WhatIsNoNumberNeverPasses) {
  for (const double value : {nan, infinity, -infinity}) {
    EXPECT_EQ(judge_limit(value, 0.0, 1.0), Verdict::fail);
    EXPECT_EQ(judge_at_least(value, 0.0, 1.0), Verdict::fail);
    EXPECT_EQ(judge_band(value, 0.0, -1.0, 1.0), Verdict::fail);
    EXPECT_EQ(equivalence(value, 0.0, 1.0), Equivalence::unresolved);
  }
  EXPECT_EQ(judge_limit(0.0, 0.0, nan), Verdict::fail);
  EXPECT_EQ(judge_at_least(0.0, 0.0, nan), Verdict::fail);
  EXPECT_EQ(judge_band(0.0, 0.0, nan, 1.0), Verdict::fail);
  EXPECT_EQ(judge_band(0.0, 0.0, -1.0, nan), Verdict::fail);
  for (const double u : {nan, infinity, -1.0}) {
    EXPECT_EQ(judge_limit(0.0, u, 1.0), Verdict::inconclusive);
    EXPECT_EQ(judge_at_least(2.0, u, 1.0), Verdict::inconclusive);
    EXPECT_EQ(judge_band(0.0, u, -1.0, 1.0), Verdict::inconclusive);
    EXPECT_EQ(equivalence(0.0, u, 1.0), Equivalence::unresolved);
  }
  EXPECT_EQ(judge_at_least(infinity, 0.0, infinity), Verdict::fail);
  EXPECT_EQ(judge_limit(1e300, 0.0, infinity), Verdict::pass);  // no ceiling is no limit that is not a number
}

TEST(Limits, TwoEnginesAreEqualWithinTheMarginOnly) {
  EXPECT_EQ(equivalence(0.0, 0.0, 1.0), Equivalence::equivalent);
  EXPECT_EQ(equivalence(0.25, 0.125, 1.0), Equivalence::equivalent);  // 0.25 = 2 u
  EXPECT_EQ(equivalence(over(0.25), 0.125, 1.0), Equivalence::negligible);
  EXPECT_EQ(equivalence(-over(0.25), 0.125, 1.0), Equivalence::negligible);
  EXPECT_EQ(equivalence(0.75, 0.125, 1.0), Equivalence::negligible);
  EXPECT_EQ(equivalence(-0.75, 0.125, 1.0), Equivalence::negligible);
  EXPECT_EQ(equivalence(over(0.75), 0.125, 1.0), Equivalence::unresolved);
  EXPECT_EQ(equivalence(-over(0.75), 0.125, 1.0), Equivalence::unresolved);
  EXPECT_EQ(equivalence(1.25, 0.125, 1.0), Equivalence::unresolved);
  EXPECT_EQ(equivalence(-1.25, 0.125, 1.0), Equivalence::unresolved);
  EXPECT_EQ(equivalence(over(1.25), 0.125, 1.0), Equivalence::different);
  EXPECT_EQ(equivalence(-over(1.25), 0.125, 1.0), Equivalence::different);
  for (const double margin : {0.0, -1.0, nan})
    EXPECT_EQ(equivalence(0.0, 0.0, margin), Equivalence::unresolved);
}

Gate gate_of(std::optional<double> limit, std::optional<double> at_least,
             std::optional<std::array<double, 2>> band) {
  Gate g;
  g.limit = limit;
  g.at_least = at_least;
  g.band = band;
  return g;
}

TEST(GateEdges, TheWorstOfWhatAGateAsksIsItsVerdict) {
  EXPECT_EQ(verdict_of(gate_of({}, {}, {}), 0.0, 0.0), Verdict::missing);
  EXPECT_EQ(verdict_of(gate_of(1.0, {}, {}), 0.5, 0.0), Verdict::pass);
  EXPECT_EQ(verdict_of(gate_of(1.0, 0.75, {}), 0.5, 0.0), Verdict::fail);
  EXPECT_EQ(verdict_of(gate_of(1.0, 0.5, {}), 0.5, 0.1), Verdict::inconclusive);
  EXPECT_EQ(verdict_of(gate_of(0.4, 0.5, {}), 0.5, 0.01), Verdict::fail);  // inconclusive beside it
  EXPECT_EQ(verdict_of(gate_of(1.0, 0.25, std::array{0.5, 0.75}), 0.5, 0.0), Verdict::pass);
  EXPECT_EQ(verdict_of(gate_of(1.0, 0.25, std::array{0.6, 0.75}), 0.5, 0.0), Verdict::fail);
  EXPECT_EQ(verdict_of(gate_of({}, {}, std::array{0.25, 0.4}), 0.5, 0.0), Verdict::fail);
}

Order interval(double low, double value, double high) {
  return {value, low, high, FitClass::asymptotic, 0.0, 0.0};
}

TEST(GateEdges, AnOrderPassesWithItsWholeInterval) {
  const auto least = gate_of({}, 1.5, {});
  EXPECT_EQ(verdict_of(least, interval(1.5, 2.0, 2.5)), Verdict::pass);
  EXPECT_EQ(verdict_of(least, interval(below(1.5), 2.0, 2.5)), Verdict::inconclusive);
  EXPECT_EQ(verdict_of(least, interval(1.0, 1.25, 1.5)), Verdict::inconclusive);
  EXPECT_EQ(verdict_of(least, interval(1.0, 1.25, below(1.5))), Verdict::fail);
  EXPECT_EQ(verdict_of(gate_of(2.5, {}, {}), interval(-9.0, 2.0, 2.5)), Verdict::pass);
  EXPECT_EQ(verdict_of(gate_of(2.5, {}, {}), interval(2.5, 2.5, 3.0)), Verdict::inconclusive);
  EXPECT_EQ(verdict_of(gate_of(2.5, {}, {}), interval(above(2.5), 2.75, 3.0)), Verdict::fail);
  EXPECT_EQ(verdict_of(gate_of({}, {}, std::array{1.5, 2.5}), interval(1.5, 1.5, 2.5)), Verdict::pass);
  EXPECT_EQ(verdict_of(gate_of({}, {}, std::array{1.5, 2.5}), interval(1.5, 2.5, above(2.5))),
            Verdict::inconclusive);
  EXPECT_EQ(verdict_of(gate_of({}, {}, {}), interval(1.0, 1.0, 1.0)), Verdict::missing);
  EXPECT_EQ(verdict_of(gate_of(3.0, 2.2, {}), interval(1.5, 2.0, 2.1)), Verdict::fail);
}

TEST(GateEdges, AnIntervalThatIsNoneFails) {
  for (const auto& order :
       {interval(2.5, 2.0, 3.0), interval(1.0, 2.0, 1.5), interval(nan, 2.0, 3.0), interval(1.0, nan, 3.0),
        interval(1.9, 2.0, infinity), interval(-infinity, 2.0, 2.5)})
    EXPECT_EQ(verdict_of(gate_of({}, -100.0, {}), order), Verdict::fail)
        << order.low << " " << order.value << " " << order.high;
  EXPECT_EQ(verdict_of(gate_of(100.0, {}, {}), interval(-infinity, 2.0, 2.5)), Verdict::fail);
}

TEST(GateEdges, ADescriptionHoldsEachFigure) {
  EXPECT_EQ(describe(gate_of({}, {}, {})), "no limit");
  EXPECT_EQ(describe(gate_of(0.125, {}, {})), "limit 0.125");
  EXPECT_EQ(describe(gate_of({}, 1.5, {})), "at least 1.5");
  EXPECT_EQ(describe(gate_of({}, {}, std::array{-1.0, 2.5})), "band -1 to 2.5");
  EXPECT_EQ(describe(gate_of(3.0, 1.0, std::array{1.0, 2.0})), "limit 3, at least 1, band 1 to 2");
}

TEST(GateEdges, AModeFitsByNameAndNotPaperFitsAllOthers) {
  Gate g;
  EXPECT_TRUE(fits_mode(g, JudgedMode::paper) && fits_mode(g, JudgedMode::corrected) &&
              fits_mode(g, JudgedMode::none));
  g.mode = JudgedMode::paper;
  EXPECT_TRUE(fits_mode(g, JudgedMode::paper));
  EXPECT_FALSE(fits_mode(g, JudgedMode::corrected));
  g.mode = JudgedMode::not_paper;
  EXPECT_FALSE(fits_mode(g, JudgedMode::paper));
  EXPECT_TRUE(fits_mode(g, JudgedMode::corrected) && fits_mode(g, JudgedMode::none));
}

TEST(GateEdges, AKnownDefectIsOneWordBeforeAColon) {
  const auto of = [](const std::string& reason) {
    Gate g;
    g.reason = reason;
    return known_defect(g);
  };
  EXPECT_EQ(of("known defect drift: it sinks"), "drift");
  EXPECT_EQ(of("known defect drift of it: it sinks"), "");
  EXPECT_EQ(of("known defect drift"), "");
  EXPECT_EQ(of("a known defect drift: it sinks"), "");
  EXPECT_EQ(of("unknown"), "");
}

TEST(GateEdges, RoomIsOneNumberForEachKindOfGate) {
  EXPECT_EQ(allowance_of(gate_of(0.5, {}, {})), 0.5);
  EXPECT_EQ(allowance_of(gate_of({}, {}, std::array{-1.0, 2.0})), 1.5);
  EXPECT_EQ(allowance_of(gate_of(0.5, 4.0, std::array{-1.0, 2.0})), 0.5);
  EXPECT_EQ(allowance_of(gate_of(2.5, {}, std::array{-1.0, 2.0})), 1.5);
  EXPECT_EQ(allowance_of(gate_of({}, 4.0, {})), 0.25);
  EXPECT_EQ(allowance_of(gate_of({}, 0.5, {})), 2.0);
  EXPECT_EQ(allowance_of(gate_of({}, 0.0, {})), infinity);
  EXPECT_EQ(allowance_of(gate_of({}, -1.0, {})), infinity);
}

TEST(ExitCodes, EachHasItsWord) {
  const std::vector<std::pair<int, std::string>> words{{exit_pass, "PASS"},
                                                       {exit_fail, "FAIL"},
                                                       {exit_bad_input, "BAD INPUT"},
                                                       {exit_inconclusive, "INCONCLUSIVE"},
                                                       {exit_missing, "MISSING"},
                                                       {exit_selftest, "SELF-TEST FAILED"},
                                                       {exit_cost, "COST REGRESSION"},
                                                       {exit_diverged, "DIVERGED"},
                                                       {exit_interrupted, "INTERRUPTED"}};
  for (const auto& [code, word] : words) EXPECT_EQ(verdict_word(code), word);
  EXPECT_EQ(first_of({1, 2, 3, 4, 5, 6, 7, exit_interrupted}), exit_interrupted);
  for (const auto& [verdict, word] :
       {std::pair{Verdict::pass, "pass"}, std::pair{Verdict::fail, "fail"},
        std::pair{Verdict::inconclusive, "inconclusive"}, std::pair{Verdict::missing, "missing"},
        std::pair{Verdict::diverged, "diverged"}})
    EXPECT_EQ(to_string(verdict), word);
}

GateRow passed(double value, double u, const Gate& gate) {
  GateRow row;
  row.metric = "error";
  row.verdict = Verdict::pass;
  row.value = value;
  row.uncertainty = u;
  row.gate = gate;
  return row;
}

TEST(HeadroomEdges, IsTheLimitOverWhatIsUsedAndWhatIsUsedOverTheLeast) {
  const auto of = [](double value, double u, const Gate& gate) {
    return headroom_of({}, passed(value, u, gate)).value_or(-1.0);
  };
  EXPECT_DOUBLE_EQ(of(-0.25, 0.125, gate_of(2.0, {}, {})), 4.0);
  EXPECT_EQ(of(0.0, 0.0, gate_of(2.0, {}, {})), infinity);
  EXPECT_DOUBLE_EQ(of(3.0, 0.5, gate_of({}, 0.5, {})), 8.0);
  // The edge on the value's side
  EXPECT_DOUBLE_EQ(of(0.5, 0.0, gate_of({}, {}, std::array{-4.0, 1.0})), 2.0);
  EXPECT_DOUBLE_EQ(of(-0.5, 0.0, gate_of(2.0, {}, std::array{-4.0, 1.0})), 4.0);
  EXPECT_DOUBLE_EQ(of(0.5, 0.0, gate_of({}, {}, std::array{0.25, 0.75})), 2.0);
  EXPECT_DOUBLE_EQ(of(2.0, 0.0, gate_of(3.0, 0.25, std::array{0.5, 2.5})), 4.0);
  EXPECT_EQ(of(1.0, 0.0, gate_of({}, 0.0, {})), -1.0);  // neither ceiling nor floor
  EXPECT_EQ(of(nan, 0.0, gate_of(1.0, {}, {})), -1.0);
  EXPECT_EQ(of(0.0, 0.0, gate_of(roundoff_limit, {}, {})), -1.0);
  EXPECT_EQ(of(0.0, 0.0, gate_of(above(roundoff_limit), {}, {})), infinity);
  auto row = passed(0.1, 0.0, gate_of(1.0, {}, {}));
  row.verdict = Verdict::fail;
  EXPECT_FALSE(headroom_of({}, row).has_value());
}

TEST(HeadroomEdges, ACountUsesAHalfAtLeastUnlessItIsScaled) {
  CaseResult c;
  c.metrics.resize(1);
  c.metrics[0].name = "error";
  const auto row = passed(0.0, 0.0, gate_of(2.0, {}, {}));
  for (const char* count :
       {"body_count", "bonded_objects", "object_count", "phase_count", "event_count", "toggles"}) {
    c.metrics[0].quantity = count;
    c.metrics[0].scale = 1.0;
    EXPECT_EQ(headroom_of(c, row), 4.0) << count;
    EXPECT_EQ(headroom_of(c, passed(1.0, 0.0, gate_of(2.0, {}, {}))), 2.0) << count;
    c.metrics[0].scale = 2.0;
    EXPECT_EQ(headroom_of(c, row), infinity) << count;
  }
  c.metrics[0].name = "another";
  c.metrics[0].scale = 1.0;
  EXPECT_EQ(headroom_of(c, row), infinity);
}

AcceptedGate accepted(std::optional<double> limit, std::optional<double> at_least,
                      std::optional<std::array<double, 2>> band, std::optional<double> drift = {}) {
  AcceptedGate g;
  g.limit = limit;
  g.at_least = at_least;
  g.band = band;
  g.drift = drift;
  return g;
}

AcceptedGate in_words(const std::string& allows) {
  AcceptedGate g;
  g.allows = allows;
  return g;
}

TEST(LooserEdges, AreNamedWithBothFigures) {
  EXPECT_EQ(looser_edge(accepted(0.25, {}, {}), accepted(0.25, {}, {})), "");
  EXPECT_EQ(looser_edge(accepted(0.125, {}, {}), accepted(0.25, {}, {})), "");
  EXPECT_EQ(looser_edge(accepted(0.5, {}, {}), accepted(0.25, {}, {})),
            "its upper edge has moved from 0.25 to 0.5");
  EXPECT_EQ(looser_edge(accepted({}, 1.0, {}), accepted(0.25, {}, {})), "its upper edge, 0.25, is gone");
  EXPECT_EQ(looser_edge(accepted({}, 1.0, {}), accepted({}, 1.5, {})),
            "its lower edge has moved from 1.5 to 1");
  EXPECT_EQ(looser_edge(accepted({}, 2.0, {}), accepted({}, 1.5, {})), "");
  EXPECT_EQ(looser_edge(accepted({}, {}, std::array{-1.0, 2.0}), accepted({}, {}, std::array{-0.5, 2.0})),
            "its lower edge has moved from -0.5 to -1");
  EXPECT_EQ(looser_edge(accepted({}, {}, std::array{-0.25, 1.0}), accepted({}, {}, std::array{-0.5, 2.0})),
            "");
  EXPECT_EQ(looser_edge(accepted(2.0, {}, {}), accepted({}, {}, std::array{-0.5, 2.0})),
            "its lower edge has moved from -0.5 to -2");
  EXPECT_EQ(looser_edge(accepted(1.0, -2.0, {}), accepted(1.0, {}, {})),
            "");  // a limit is a lower edge too, and the nearer one counts
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}), accepted(1.0, -0.5, {})),
            "its lower edge has moved from -0.5 to -1");
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}), accepted(1.0, {}, std::array{-3.0, 0.5})),
            "its upper edge has moved from 0.5 to 1");
  EXPECT_EQ(looser_edge(accepted(1.0 + 0.9e-9, {}, {}), accepted(1.0, {}, {})), "");
  EXPECT_NE(looser_edge(accepted(1.0 + 1.1e-9, {}, {}), accepted(1.0, {}, {})), "");
}

TEST(LooserEdges, ADriftThatGrowsOrIsGoneIsLooser) {
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}, 0.5), accepted(1.0, {}, {}, 0.5)), "");
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}, 0.5), accepted(1.0, {}, {}, 0.25)),
            "the drift that it allows was 0.25 and is 0.5");
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}), accepted(1.0, {}, {}, 0.25)),
            "the drift that it allows was 0.25 and is not bounded");
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}, 0.25), accepted(1.0, {}, {})), "");
}

TEST(LooserEdges, OfWordsAreReadFromThem) {
  EXPECT_EQ(looser_edge(accepted(0.5, {}, {}), in_words("limit 0.25")),
            "its upper edge has moved from 0.25 to 0.5");
  EXPECT_EQ(looser_edge(accepted({}, 1.0, {}), in_words("at least 1.5")),
            "its lower edge has moved from 1.5 to 1");
  EXPECT_EQ(looser_edge(accepted({}, {}, std::array{-1.0, 2.0}), in_words("limit 9, band -0.5 to 2")),
            "its lower edge has moved from -0.5 to -1");
  EXPECT_EQ(looser_edge(accepted({}, {}, std::array{-0.5, 2.0}), in_words("limit 9, band -0.5 to 2")), "");
  EXPECT_EQ(looser_edge(accepted({}, {}, std::array{-0.5, 2.5}), in_words("limit 9, band -0.5 to 2")),
            "its upper edge has moved from 2 to 2.5");
  EXPECT_EQ(looser_edge(accepted(1.000009, {}, {}), in_words("limit 1")), "");  // six digits
  EXPECT_NE(looser_edge(accepted(1.000011, {}, {}), in_words("limit 1")), "");
  EXPECT_EQ(looser_edge(accepted(1.0, {}, {}), in_words("class asymptotic")), "");
}

}  // namespace
}  // namespace tripoint
