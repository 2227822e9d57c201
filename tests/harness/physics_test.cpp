// SPDX-License-Identifier: BSD-3-Clause
// The second verdict, right or wrong, beside that of the gate, which says as expected or not.
#include "validation/judge/physics.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "judged.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace {

Gate declared(double low, double high, const std::string& reason = "known defect soft-contact: it sinks in") {
  auto g = limit("error", 0.0);
  g.limit.reset();
  g.engine = "stone";
  g.band = {low, high};
  g.reason = reason;
  return g;
}

/// `green()` with an engine that is `e` off beside the acceptance limit of 0.1.
Results with(double e, const std::vector<Gate>& gates = {}) {
  auto r = green();
  EngineRow stone;
  stone.name = "stone";
  stone.runs = {run_with({{"error", value(e)}})};
  r.cases[0].engines.push_back(stone);
  for (const auto& g : gates) r.cases[0].gates.push_back(g);
  judge(r);
  return r;
}

const EngineRow& stone(const Results& r) { return r.cases[0].engines[1]; }

TEST(Physics, OfAValueWithinTheAcceptanceLimitIsRight) {
  const auto r = with(0.05);
  EXPECT_EQ(stone(r).gates.at(0).physics, Physics::right);
  EXPECT_EQ(stone(r).physics, Physics::right);
  EXPECT_EQ(r.cases[0].physics, Physics::right);
}

TEST(Physics, OfAValueBeyondItIsWrong) {
  const auto r = with(0.2);
  EXPECT_EQ(stone(r).gates.at(0).physics, Physics::wrong);
  EXPECT_EQ(r.cases[0].engines[0].physics, Physics::right);
  EXPECT_EQ(r.cases[0].physics, Physics::wrong);
}

TEST(Physics, OfADeclaredDefectThatHoldsIsGreenForTheGateAlone) {
  const auto r = with(0.3, {declared(0.2, 0.4)});
  EXPECT_EQ(r.exit_code, exit_pass);
  ASSERT_EQ(stone(r).gates.size(), 1U);
  EXPECT_EQ(stone(r).gates[0].verdict, Verdict::pass);
  EXPECT_EQ(stone(r).gates[0].physics, Physics::known_defect);
  EXPECT_EQ(physics_text(stone(r).gates[0]), "known defect soft-contact");
  EXPECT_EQ(stone(r).defects, std::vector<std::string>{"soft-contact"});
  EXPECT_EQ(physics_text(r.cases[0]), "known defect soft-contact (stone)");
}

TEST(Physics, OfADeclaredDefectThatHasGrownIsWrong) {
  const auto r = with(0.6, {declared(0.2, 0.4)});
  EXPECT_EQ(stone(r).gates.at(0).physics, Physics::wrong);
  EXPECT_EQ(r.exit_code, exit_fail);
}

TEST(Physics, OfADefectThatIsCuredIsRightThoughItsGateIsRed) {
  const auto r = with(0.05, {declared(0.2, 0.4)});
  EXPECT_EQ(r.exit_code, exit_fail);
  for (const auto& row : stone(r).gates) EXPECT_EQ(row.physics, Physics::right) << row.why;
  EXPECT_EQ(stone(r).gates.size(), 2U);
}

TEST(Physics, OfAPredictedDefectIsKnownAndOfNoValueIsNotKnown) {
  auto r = with(0.05, {declared(0.01, 0.09, "predicted defect: the printed form lags")});
  EXPECT_EQ(stone(r).physics, Physics::known_defect);
  auto unsure = green();
  error(unsure).uncertainty.statistical = 0.1;
  judge(unsure);
  EXPECT_EQ(engine(unsure).gates.at(0).verdict, Verdict::inconclusive);
  EXPECT_EQ(engine(unsure).physics, Physics::unknown);
}

TEST(Physics, StandsBesideTheVerdictInEveryFile) {
  auto r = with(0.3, {declared(0.2, 0.4)});
  const auto document = nlohmann::json::parse(results_text(r));
  const auto& stone = document["cases"][0]["engines"][1];
  EXPECT_EQ(stone["physics"], "known defect");
  EXPECT_EQ(stone["defects"][0], "soft-contact");
  EXPECT_EQ(stone["gates"][0]["verdict"], "pass");
  EXPECT_EQ(stone["gates"][0]["physics"], "known defect");
  EXPECT_EQ(stone["gates"][0]["defect"], "soft-contact");
  EXPECT_NEAR(stone["gates"][0]["used"].get<double>(), 0.0, 1e-12);
  EXPECT_EQ(document["cases"][0]["physics"], "known defect");
  EXPECT_NE(junit_text(r).find("name=\"physics\" value=\"known defect soft-contact\""), std::string::npos);
  EXPECT_NE(summary_text(r).find("| PASS | known defect soft-contact (stone) | test/one |"),
            std::string::npos)
      << summary_text(r);
  EXPECT_NE(case_line(r.cases[0]).find("physics known defect soft-contact (stone)"), std::string::npos);
}

}  // namespace
}  // namespace tripoint
