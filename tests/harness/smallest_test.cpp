// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "validation/mutation/selftest.hpp"
#include "validation/mutation/smallest.hpp"

namespace tripoint {
namespace {

TEST(SmallestDefect, IsFoundToFivePerCentWhereverTheSearchBegins) {
  for (const double truth : {1e-12, 3e-4, 0.02, 0.9})
    for (const double start : {1e-9, 0.01, 1.0}) {
      const auto found = smallest_visible(start, 1.0, [&](double size) { return size >= truth; });
      ASSERT_TRUE(found.found && found.size) << truth << " from " << start;
      EXPECT_GE(*found.size, truth);
      EXPECT_LT(found.hidden, truth);
      EXPECT_LE(*found.size / found.hidden, smallest_resolution * (1.0 + 1e-9));
      EXPECT_LE(found.runs, 25) << truth << " from " << start;
    }
}

TEST(SmallestDefect, ThatIsStoredAsItIsTakesTwoRuns) {
  EXPECT_EQ(smallest_visible(0.02, 1.0, [](double size) { return size >= 0.0196; }).runs, 2);
}

TEST(SmallestDefect, IsNotSoughtBeyondTheDeclaredSize) {
  const auto found = smallest_visible(0.5, 1.0, [](double size) { return size > 1.0; });
  EXPECT_FALSE(found.size);
  EXPECT_FALSE(found.found);
}

TEST(SmallestDefect, AGateThatIsAlwaysRedHasNone) {
  EXPECT_FALSE(smallest_visible(0.5, 1.0, [](double) { return true; }).found);
}

TEST(SmallestDefect, AnIntervalIsNotLeftByANumberThatIsNotFinite) {
  EXPECT_FALSE(smallest_visible(0.5, 1.0, [](double size) {
                 return size > std::numeric_limits<double>::infinity();
               }).found);
}

TEST(SmallestDefect, HasGrownWhenALimitIsLoosenedByMoreThanAQuarter) {
  EXPECT_EQ(against_stored(0.024, 0.02), Size::held);
  EXPECT_EQ(against_stored(0.026, 0.02), Size::grew);
  EXPECT_EQ(against_stored(0.01, 0.02), Size::shrank);
}

TEST(SmallestDefect, IsInTheTableAndTheDocumentOfTheSelfTest) {
  SelftestOutcome outcome;
  SmallestOutcome s;
  s.defect = "heat.conductivity";
  s.case_id = "heat/cosine-mode";
  s.metric = "rate";
  s.size = 0.0052;
  s.hidden = 0.005;
  s.stored = 0.004;
  s.verdict = Size::grew;
  s.place = {"cases/heat/cosine-mode.toml", 7, 1};
  outcome.smallest = {s};
  EXPECT_NE(selftest_table(outcome).find("GREW        heat.conductivity"), std::string::npos)
      << selftest_table(outcome);
  EXPECT_NE(selftest_table(outcome).find("cosine-mode.toml:7"), std::string::npos);
  EXPECT_NE(selftest_table(outcome).find("0 of 1 smallest visible sizes held"), std::string::npos);
  EXPECT_NE(selftest_json(outcome).find("\"holds\": false"), std::string::npos);
}

}  // namespace
}  // namespace tripoint
