// SPDX-License-Identifier: BSD-3-Clause
// Limits that any engine must hold, declared defects, and the scorecard, on results made by hand.
#include <gtest/gtest.h>

#include "judged.hpp"
#include "validation/case/case.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/remarks.hpp"
#include "validation/publish/scorecard.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

EngineRow row(const std::string& name, double e, const std::string& preset = "default") {
  EngineRow r;
  r.name = name;
  r.preset = preset;
  r.runs = {run_with({{"error", value(e)}})};
  r.runs[0].cost.cpu_s = 2.0;
  return r;
}

Gate declared(const std::string& engine, double low, double high) {
  auto g = limit("error", 0.0);
  g.limit.reset();
  g.engine = engine;
  g.band = {low, high};
  g.reason = "known defect no-term: it leaves the term out";
  return g;
}

/// `green()` with a second engine that is `e` off, beside the limit of 0.1.
Results with(double e) {
  auto r = green();
  engine(r).runs[0].cost.cpu_s = 1.0;
  r.cases[0].engines.push_back(row("stone", e));
  return r;
}

Scorecard card_of(Results r) {
  judge(r);
  return scorecard_of(r, {}, {});
}

const ScoreRow& of(const Scorecard& card, const std::string& engine) {
  for (const auto& s : card.engines)
    if (s.engine == engine) return s.rows.at(0);
  throw std::out_of_range(engine);
}

TEST(KnownDefect, IsNamedByTheReason) {
  EXPECT_EQ(known_defect(declared("stone", 0.2, 0.4)), "no-term");
  EXPECT_EQ(known_defect(limit("error", 0.1)), "");
  auto words = limit("error", 0.1);
  words.reason = "known defect of the core of pairs: 0.44 measured";  // a sentence, no declaration
  EXPECT_EQ(known_defect(words), "");
}

TEST(KnownDefect, ExcusesTheEngineThatItNamesAndNoOther) {
  auto r = with(0.3);
  EXPECT_EQ(exit_of(r), exit_fail);
  r.cases[0].gates.push_back(declared("stone", 0.2, 0.4));
  EXPECT_EQ(exit_of(r), exit_pass);
  r.cases[0].engines.push_back(row("brick", 0.3));
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(KnownDefect, ThatHasChangedIsRed) {
  auto r = with(0.5);
  r.cases[0].gates.push_back(declared("stone", 0.2, 0.4));
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(KnownDefect, ThatIsThereNoMoreIsRedThoughItsBandHolds) {
  auto r = with(0.05);
  r.cases[0].gates.push_back(declared("stone", 0.01, 0.4));
  judge(r);
  EXPECT_EQ(r.exit_code, exit_fail);
  EXPECT_NE(r.cases[0].engines[1].gates[0].why.find("take the declaration away"), std::string::npos);
}

TEST(KnownDefect, OfOnePresetExcusesNoOther) {
  auto r = with(0.3);
  r.cases[0].engines[1].preset = "plain";
  r.cases[0].engines.push_back(row("stone", 0.3, "fancy"));
  auto g = declared("stone", 0.2, 0.4);
  g.preset = "plain";
  r.cases[0].gates.push_back(g);
  judge(r);
  EXPECT_EQ(r.exit_code, exit_fail);
  EXPECT_EQ(r.cases[0].engines[2].gates[0].verdict, Verdict::fail);
}

TEST(AcceptanceOrder, OfRoundOffIsNoneAndHoldsForEveryEngineAlone) {
  auto r = study_of({1e-15, 2e-15, 1e-15, 3e-15});
  r.cases[0].gates[0].at_least = 1.0;
  EXPECT_EQ(exit_of(r), exit_pass);
  r.cases[0].gates[0].engine = "tripoint";  // who is named is asked for what is known of it
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(AcceptanceOrder, OfAnErrorFarBelowTheLimitOfTheLadderIsNoneAndHolds) {
  const auto with_limit = [](double most) {
    auto r = study_of({5e-5, 3e-6, 4e-7, 6e-7});  // fourth order down to single precision
    r.cases[0].gates[0].at_least = 0.8;
    r.cases[0].gates.push_back(limit("error.limit", most));
    return r;
  };
  EXPECT_EQ(exit_of(with_limit(1e-2)), exit_pass);
  EXPECT_NE(exit_of(with_limit(1e-4)), exit_pass);
  auto alone = with_limit(1e-2);
  alone.cases[0].gates.pop_back();
  EXPECT_NE(exit_of(alone), exit_pass);
}

/// An inertia that is 1 % off: the errors fall to a floor, and a power law through what is above it has the
/// order 4.
std::vector<double> floored() { return {0.0376231689, 0.0376231639, 0.0376231636, 0.0376231636}; }

TEST(AcceptanceOrder, OfAnErrorThatEndsOnAFloorIsNone) {
  for (const auto& errors : {floored(),
                             {0.108, 0.081, 0.074, 0.072},
                             {0.54, 0.29, 0.165, 0.1025},
                             {0.52, 0.27, 0.2075, 0.191875}}) {
    auto r = study_of(errors);
    r.cases[0].gates[0].at_least = 0.8;
    judge(r);
    EXPECT_EQ(engine(r).gates.at(0).fit_class, FitClass::plateau) << errors[0];
    EXPECT_EQ(r.exit_code, exit_fail) << errors[0];
    EXPECT_NE(engine(r).gates[0].why.find("does not fall to the truth"), std::string::npos)
        << engine(r).gates[0].why;
    EXPECT_TRUE(std::isnan(engine(r).gates[0].used));
  }
}

TEST(AcceptanceOrder, OfAFloorThatIsDeclaredIsAsExpected) {
  auto r = study_of({0.54, 0.29, 0.165, 0.1025});  // first order above a floor of 0.04
  auto& gate = r.cases[0].gates[0];
  gate.at_least.reset();
  gate.expect = FitClass::plateau;
  EXPECT_EQ(exit_of(r), exit_pass);
  gate.band = {0.9, 1.1};  // the class and the number
  EXPECT_EQ(exit_of(r), exit_pass);
  gate.band = {5.0, 6.0};
  EXPECT_EQ(exit_of(r), exit_fail);
  auto falls = study_of({0.4, 0.1, 0.025, 0.00625});
  falls.cases[0].gates[0] = gate;
  falls.cases[0].gates[0].band.reset();
  EXPECT_EQ(exit_of(falls), exit_fail);
}

/// A gate on where the ladder ends.
Results ending(const std::vector<double>& errors, double most) {
  auto r = study_of(errors);
  auto& gate = r.cases[0].gates[0];
  gate = limit("error.limit", most);
  judge(r);
  return r;
}

TEST(LimitOfTheLadder, IsHeldByASchemeAndBrokenByAConstant) {
  EXPECT_EQ(ending({0.4, 0.2, 0.1, 0.05}, 0.01).exit_code, exit_pass);
  EXPECT_EQ(ending({0.4, 0.1, 0.025, 0.00625}, 0.01).exit_code, exit_pass);
  EXPECT_EQ(ending(floored(), 0.01).exit_code, exit_fail);
  // 0.03 beneath a first order
  EXPECT_EQ(ending({0.43, 0.23, 0.13, 0.08}, 0.01).exit_code, exit_fail);
  EXPECT_EQ(ending({0.43, 0.13, 0.055, 0.03625}, 0.01).exit_code, exit_fail);     // beneath a second
  EXPECT_EQ(ending({0.5, 0.31, 0.22, 0.05}, 0.01).exit_code, exit_inconclusive);  // it tells nothing
}

TEST(LimitOfTheLadder, StandsInTheRowWithItsUncertainty) {
  const auto r = ending({0.43, 0.23, 0.13, 0.08}, 0.01);
  const auto& row = r.cases[0].engines[0].gates.at(0);
  EXPECT_NEAR(row.value, 0.03, 1e-9);
  EXPECT_LT(row.uncertainty, 1e-9);
  EXPECT_EQ(row.budget.numerical, row.uncertainty);
  EXPECT_NEAR(row.used, 3.0, 1e-6);
  EXPECT_NE(row.why.find("extrapolated to step 0"), std::string::npos);
}

TEST(LimitOfTheLadder, OfLevelsThatDidNotRunIsMissing) {
  auto r = study_of({0.4, 0.2, 0.1, std::nan("")});
  r.cases[0].gates[0] = limit("error.limit", 0.01);
  EXPECT_EQ(exit_of(r), exit_missing);
}

TEST(AcceptanceOrder, BelowTheLeastIsRed) {
  auto r = study_of({0.1, 0.09, 0.081, 0.073});
  r.cases[0].gates[0].at_least = 0.8;
  EXPECT_EQ(exit_of(r), exit_fail);
}

TEST(NotPaper, StudiesLeaveOutOurPrintedFormOnly) {
  Study s;
  s.mode = JudgedMode::not_paper;
  EXPECT_TRUE(applies(s, "tripoint", JudgedMode::corrected));
  EXPECT_FALSE(applies(s, "tripoint", JudgedMode::paper));
  EXPECT_TRUE(applies(s, "stone", JudgedMode::none));
  EXPECT_FALSE(applies(s, "exact", JudgedMode::none));
}

TEST(Scorecard, HoldsErrorLimitCostAndRank) {
  const auto card = card_of(with(0.08));
  const auto& stone = of(card, "stone");
  EXPECT_EQ(stone.verdict, Score::pass);
  EXPECT_EQ(stone.error, 0.08);
  EXPECT_EQ(stone.allowed, "limit 0.1");
  EXPECT_NEAR(stone.share, 0.8, 1e-12);
  EXPECT_EQ(stone.cost, 2.0);
  EXPECT_EQ(stone.rank, 2);
  EXPECT_EQ(stone.of, 2);
  EXPECT_EQ(stone.cause, "");
  EXPECT_EQ(of(card, "tripoint").rank, 1);
  EXPECT_TRUE(card.disagreements.empty());
}

TEST(Scorecard, EqualErrorsShareAPlace) {
  const auto card = card_of(with(0.05 * (1.0 + 1e-9)));
  EXPECT_EQ(of(card, "stone").rank, 1);
  EXPECT_EQ(of(card, "tripoint").rank, 1);
}

/// A case whose truth is `angle`, and whose energy an engine keeps that turns nothing.
Results spinning(double angle, double energy) {
  auto r = green();
  auto& c = r.cases[0];
  c.metrics.resize(2);
  c.metrics[0].name = "energy";
  c.metrics[0].quantity = "ledger.kinetic";
  c.metrics[0].norm = Norm::drift;
  c.metrics[1].name = "angle";
  c.metrics[1].quantity = "orientation";
  c.metrics[1].norm = Norm::final;
  c.gates = {limit("energy", 0.1), limit("angle", 0.1)};
  engine(r).runs = {run_with({{"energy", value(0.01)}, {"angle", value(0.02)}})};
  c.engines.push_back(row("stone", 0.0));
  c.engines[1].runs = {run_with({{"energy", value(energy)}, {"angle", value(angle)}})};
  return r;
}

TEST(Rank, IsByTheTruthThoughEnergyIsTheFirstLimit) {
  const auto card = card_of(spinning(0.05, 0.0));
  EXPECT_EQ(of(card, "stone").metric, "angle");
  EXPECT_EQ(of(card, "stone").rank, 2);
  EXPECT_EQ(of(card, "tripoint").rank, 1);
}

TEST(Rank, IsByMomentumWhereOnlyLawsAreKnown) {
  auto r = spinning(0.05, 0.0);
  r.cases[0].metrics[1].quantity = "angular_momentum";
  EXPECT_EQ(of(card_of(r), "stone").metric, "angle");
  EXPECT_EQ(of(card_of(r), "stone").rank, 2);
}

TEST(Rank, IsNoneOfWhoFailsAnyLimit) {
  const auto card = card_of(spinning(0.3, 0.0));
  EXPECT_EQ(of(card, "stone").verdict, Score::fail);
  EXPECT_EQ(of(card, "stone").rank, 0);
  EXPECT_EQ(of(card, "tripoint").rank, 1);
  EXPECT_EQ(of(card, "tripoint").of, 1);
}

TEST(Rank, IsNoneOfWhoHoldsByAKnownDefectAlone) {
  auto r = with(0.3);
  r.cases[0].gates.push_back(declared("stone", 0.2, 0.4));
  EXPECT_EQ(of(card_of(r), "stone").rank, 0);
  r = spinning(0.001, 0.3);  // the defect is in another metric than the one that ranks
  auto g = declared("stone", 0.2, 0.4);
  g.metric = "energy";
  r.cases[0].gates.push_back(g);
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::known_defect);
  EXPECT_EQ(of(card_of(r), "stone").rank, 0);
  EXPECT_EQ(of(card_of(r), "tripoint").of, 1);
}

TEST(Drift, ShowsAConservedQuantityAndNoTurn) {
  auto r = spinning(0.05, 0.004);
  r.cases[0].metrics[1].norm = Norm::drift;  // of an orientation: a right run turns
  const auto card = card_of(r);
  EXPECT_EQ(of(card, "stone").drift_metric, "energy");
  EXPECT_EQ(of(card, "stone").drift, 0.004);
}

TEST(Cause, IsTheKnownDefectOfAnotherEngineWhoseBandHoldsTheError) {
  auto r = with(0.3);
  r.cases[0].gates.push_back(declared("brick", 0.2, 0.4));
  EXPECT_EQ(of(card_of(r), "stone").cause, "error 0.3: as of an engine without term (brick)");
  EXPECT_NE(scorecard_markdown(card_of(r)).find("as of an engine without term (brick)"), std::string::npos);
  r.cases[0].gates.back().band = {0.4, 0.6};
  EXPECT_EQ(of(card_of(r), "stone").cause, "");
  r.cases[0].gates.back().band = {0.01, 0.6};  // it would be like anything
  EXPECT_EQ(of(card_of(r), "stone").cause, "");
}

TEST(Cause, IsTheNarrowestOfSeveral) {
  auto r = with(0.3);
  r.cases[0].gates.push_back(declared("brick", 0.2, 0.4));
  r.cases[0].gates.push_back(declared("slate", 0.29, 0.31));
  r.cases[0].gates.back().reason = "known defect soft-contact: it gives way";
  EXPECT_EQ(of(card_of(r), "stone").cause, "error 0.3: as of an engine with soft contact (slate)");
}

TEST(Cause, IsTheSizeOfARegisteredDefectWhereItsSmallestIsKnown) {
  auto r = with(0.3);
  r.cases[0].gates.push_back(limit("error", 0.06));
  r.cases[0].gates.back().engine = "tripoint";
  Case known;
  known.id = "test/one";
  Defect inertia;
  inertia.name = "rigid.inertia";
  inertia.smallest = 0.004;
  inertia.killed_by = {"error"};
  known.defects = {inertia};
  judge(r);
  EXPECT_EQ(of(scorecard_of(r, {known}, {}), "stone").cause,
            "error 0.3: as of rigid.inertia off by about 0.02 of itself");
  known.defects[0].killed_by = {"energy"};
  EXPECT_EQ(of(scorecard_of(r, {known}, {}), "stone").cause, "");
}

TEST(Scorecard, TellsFailRefusedCrashedAndKnownDefectsApart) {
  EXPECT_EQ(of(card_of(with(0.2)), "stone").verdict, Score::fail);
  auto r = with(0.3);
  r.cases[0].gates.push_back(declared("stone", 0.2, 0.4));
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::known_defect);
  EXPECT_NE(of(card_of(r), "stone").reason.find("no-term"), std::string::npos);
  r = with(0.05);
  auto& run = r.cases[0].engines[1].runs[0];
  run.status = Status::refused;
  run.reason = "knows no heat";
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::refused);
  EXPECT_EQ(of(card_of(r), "stone").reason, "knows no heat");
  run.status = Status::timeout;
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::crashed);
}

TEST(Scorecard, WhatNoAcceptanceLimitLooksAtIsNotJudged) {
  auto r = with(0.05);
  r.cases[0].gates[0].engine = "tripoint";
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::not_judged);
}

TEST(Scorecard, SaysWhoIsRightWhereTwoDiffer) {
  const auto card = card_of(with(0.3));
  ASSERT_EQ(card.disagreements.size(), 1U);
  const auto& d = card.disagreements[0];
  EXPECT_NEAR(d.difference, 0.25, 1e-12);
  EXPECT_EQ(d.witnesses.at(0).label, "tripoint");
  EXPECT_EQ(d.witnesses.at(1).error, 0.3);
  EXPECT_NE(scorecard_markdown(card).find("| stone | 0.3 | fail |"), std::string::npos);
}

TEST(Refusal, OfACaseByAllThatWereChosenIsNoFailureUnlessItIsOfEveryCase) {
  auto r = green();
  auto& mine = engine(r);
  mine.name = "mine";
  mine.required = false;
  mine.runs[0].status = Status::refused;
  mine.runs[0].reason = "knows no heat";
  EXPECT_EQ(exit_of(r), exit_missing);  // nobody chose: a case that no gate judges
  r.only_engines = r.asked = {"mine"};
  judge(r);
  EXPECT_EQ(r.exit_code, exit_missing);  // it ran no case at all
  EXPECT_EQ(r.verdict, CaseVerdict::refused);
  ASSERT_EQ(r.problems.size(), 1U);
  EXPECT_NE(r.problems[0].find("refuses the one case, and nothing of it is judged"), std::string::npos)
      << r.problems[0];
  EXPECT_NE(r.problems[0].find("knows no heat"), std::string::npos) << r.problems[0];
  EXPECT_EQ(verdict_word(exit_missing, r, verdict_remarks(r)), "REFUSED");
  auto other = green().cases[0];
  other.id = "test/two";
  other.engines[0].name = "mine";
  r.cases.push_back(other);
  r.planned.push_back(other.id);
  judge(r);
  EXPECT_EQ(r.exit_code, exit_pass);
  EXPECT_EQ(r.cases[0].verdict, CaseVerdict::refused);
  r.cases[0].engines[0].required = true;
  judge(r);
  EXPECT_EQ(r.exit_code, exit_missing);
  EXPECT_EQ(r.verdict, CaseVerdict::missing);
}

/// `green()` beside a second engine of whom the case says that it refuses, "no heat" being part of its
/// reason.
Results expected_to_refuse(Status status, const std::string& reason) {
  auto r = with(0.05);
  auto& stone = r.cases[0].engines[1];
  stone.refuses = "no heat";
  stone.runs[0].status = status;
  stone.runs[0].reason = reason;
  return r;
}

TEST(ExpectedRefusal, HoldsWhereTheEngineRefusesForThatReason) {
  const auto r = expected_to_refuse(Status::refused, "it knows no heat");
  EXPECT_EQ(exit_of(r), exit_pass);
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::refused);
  EXPECT_EQ(of(card_of(r), "stone").reason, "as expected: it knows no heat");
  EXPECT_NE(scorecard_text(card_of(r), {"stone"}).find("refused, as expected: it knows no heat"),
            std::string::npos);
}

TEST(ExpectedRefusal, OfWhoTakesTheCaseIsRedThoughEveryLimitHolds) {
  auto r = expected_to_refuse(Status::ok, "");
  judge(r);
  EXPECT_EQ(r.exit_code, exit_fail);
  EXPECT_NE(r.cases[0].problems.at(0).find("take the declaration away"), std::string::npos);
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::fail);
}

TEST(ExpectedRefusal, ForAnotherReasonIsRed) {
  EXPECT_EQ(exit_of(expected_to_refuse(Status::refused, "it knows no liquid")), exit_fail);
  EXPECT_EQ(of(card_of(expected_to_refuse(Status::refused, "it knows no liquid")), "stone").verdict,
            Score::fail);
}

TEST(ExpectedRefusal, OfWhoIsNotHereIsNoFailure) {
  auto r = expected_to_refuse(Status::missing, "");
  r.cases[0].engines[1].status = Status::missing;
  r.cases[0].engines[1].runs.clear();
  EXPECT_EQ(exit_of(r), exit_pass);
}

TEST(ExpectedRefusal, IsASettingThatIsKeptBack) {
  EXPECT_EQ(declared_refusal({{"refuses", std::string("no heat")}, {"friction", 0.3}}), "no heat");
  EXPECT_EQ(declared_refusal({{"friction", 0.3}}), "");
}

TEST(Scorecard, LeavesOutWhoIsNotHereUnlessAskedFor) {
  auto r = with(0.05);
  r.cases[0].engines[1].runs.clear();
  r.cases[0].engines[1].status = Status::missing;
  EXPECT_EQ(card_of(r).engines.size(), 1U);
  r.asked = {"stone"};
  EXPECT_EQ(of(card_of(r), "stone").verdict, Score::missing);
}

}  // namespace
}  // namespace tripoint
