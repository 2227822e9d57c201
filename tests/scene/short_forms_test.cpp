// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "validation/case/case_document.hpp"

/// Gates within metrics, limits by level, invariants: each is the long form, written shorter.
namespace tripoint::test {
namespace {

const std::string metric = six_lines + "[[metric]]\nname = \"place\"\nquantity = \"position\"\n";
const std::string study =
    "[[study]]\naxis = \"time_step\"\nlevels = [0.25, 0.001, 0.0005]\nmetric = \"place\"\n";

/// What was read, but for the names that come from the file's place.
std::string unnamed_decisions(const CaseReading& r) {
  std::string text;
  for (const auto& d : r.decisions)
    if (d.key != "case.id" && d.key != "case.title")
      text += d.key + " = " + d.value + (d.given ? " given\n" : "\n");
  return text;
}

TEST(ShortForms, GatesWithinAMetricAreGates) {
  const auto within =
      read_text(metric +
                "gates = [\n{ engine = \"tripoint\", limit = 1e-3, reason = \"r\" },\n{ metric = "
                "\"place.order\", band = [1, 2], reason = \"q\" },\n]\n" +
                study);
  const auto apart = read_text(metric +
                               "[[gate]]\nmetric = \"place\"\nengine = \"tripoint\"\nlimit = 1e-3\nreason = "
                               "\"r\"\n[[gate]]\nmetric = \"place.order\"\nband = [1, 2]\nreason = \"q\"\n" +
                               study);
  EXPECT_EQ(unnamed_decisions(within), unnamed_decisions(apart));
  EXPECT_EQ(within.value.gates[1].place.line, 12);
}

TEST(ShortForms, LimitsAreOneGateALevel) {
  const auto r = read_text(
      metric +
      "limits = { 1e-3 = 0.05, 0.0005 = 0.02 }\nreason = \"first order\"\ngates = [{ engine = \"bullet\", "
      "limits = { \"0.25\" = 3 }, reason = \"its own\" }]\n" +
      study);
  ASSERT_EQ(r.value.gates.size(), 3U);
  EXPECT_EQ(r.value.gates[0].level, 1e-3);
  EXPECT_EQ(r.value.gates[0].limit, 0.05);
  EXPECT_EQ(r.value.gates[1].level, 0.0005) << "a bare key with a dot";
  EXPECT_EQ(r.value.gates[1].reason, "first order");
  EXPECT_EQ(r.value.gates[2].level, 0.25);
  EXPECT_EQ(r.value.gates[2].engine, "bullet");
}

TEST(ShortForms, InvariantsAreAMetricAndItsGate) {
  const std::string both = "[case]\nmodes = [\"corrected\", \"paper\"]\n" + six_lines;
  const auto brief = read_text(
      both +
      "[invariants]\nledger = 1e-11\nbody_count = { name = \"bodies\", value = 2, engine = "
      "\"tripoint\", limit = 0, reason = \"r\" }\n[invariants.momentum]\nscale = 2.5\ngates = [\n{ mode "
      "= \"corrected\", limit = 1e-12 },\n{ mode = \"paper\", band = [0, 1], reason = \"q\" },\n]\n");
  const auto whole = read_text(
      both +
      "[[metric]]\nname = \"ledger\"\nquantity = \"ledger.residual\"\nnorm = \"drift\"\n"
      "[[metric]]\nname = \"bodies\"\nquantity = \"body_count\"\nnorm = \"final\"\nreference = { kind = "
      "\"bound\", function = \"stated\", args = { value = 2 } }\n"
      "[[metric]]\nname = \"momentum\"\nquantity = \"momentum\"\nnorm = \"drift\"\nscale = 2.5\n"
      "[[gate]]\nmetric = \"ledger\"\nlimit = 1e-11\nreason = \"round-off\"\n"
      "[[gate]]\nmetric = \"bodies\"\nengine = \"tripoint\"\nlimit = 0\nreason = \"r\"\n"
      "[[gate]]\nmetric = \"momentum\"\nmode = \"corrected\"\nlimit = 1e-12\nreason = \"round-off\"\n"
      "[[gate]]\nmetric = \"momentum\"\nmode = \"paper\"\nband = [0, 1]\nreason = \"q\"\n");
  EXPECT_EQ(unnamed_decisions(brief), unnamed_decisions(whole));
}

TEST(ShortForms, EveryInvariantIsAQuantityThatTheReaderTakes) {
  for (const auto& one : invariants()) {
    const auto r =
        read_text(six_lines + "[invariants]\n" + std::string(one.name) + " = { limit = 1, reason = \"r\"" +
                  (one.value == "!" ? ", value = 1" : "") + " }\n");
    ASSERT_EQ(r.value.metrics.size(), 1U);
    EXPECT_EQ(r.value.metrics[0].quantity, one.quantity);
    EXPECT_EQ(r.value.metrics[0].norm, one.norm);
    EXPECT_EQ(r.value.metrics[0].reference.has_value(), !one.value.empty());
  }
}

void expect_refused_at(const std::string& text, const std::string& place, const std::string& says) {
  const auto what = refusal(text);
  EXPECT_EQ(what.find("case.toml:" + place + ":"), 0U) << what;
  EXPECT_NE(what.find(says), std::string::npos) << what;
}

TEST(ShortForms, AreRefusedWithTheirPlaceWhereTheyAreWrong) {
  expect_refused_at(metric + "gates = 3\n", "10", "array of tables");
  expect_refused_at(metric + "gates = [3]\n", "10", "must be a table");
  expect_refused_at(metric + "gates = [{ limit = 1 }]\n", "10", "reason");
  expect_refused_at(metric + "gates = [{ limt = 1, reason = \"r\" }]\n", "10", "did you mean `limit`");
  expect_refused_at(metric + "gates = [{ metric = \"speed\", limit = 1, reason = \"r\" }]\n", "10",
                    "judges \"place\"");
  expect_refused_at(metric + "gates = [{ reason = \"r\" }]\n", "10", "no limit and would pass anything");
  expect_refused_at(metric + "limits = { 1e-3 = 1 }\n", "10", "need its key `reason`");
  expect_refused_at(metric + "reason = \"r\"\n", "10", "is that of its `limits`");
  expect_refused_at(metric + "reason = \"r\"\nlimits = { fine = 1 }\n", "11", "`fine` is no number");
  expect_refused_at(metric + "reason = \"r\"\nlimits = {}\n", "11", "LEVEL = LIMIT");
  expect_refused_at(metric + "gates = [{ limits = { 1 = 1 }, level = 2, reason = \"r\" }]\n", "10",
                    "beside `limits`");
  expect_refused_at(six_lines + "[[metric]]\nquantity = \"position\"\ngates = []\n", "7", "needs its `name`");
  expect_refused_at(six_lines + "invariants = [\"ledger\"]\n", "7", "");
  expect_refused_at(six_lines + "[invariants]\nledgr = 1\n", "8", "did you mean `ledger`");
  expect_refused_at(six_lines + "[invariants]\nledger = { limt = 1 }\n", "8", "did you mean `limit`");
  expect_refused_at(six_lines + "[invariants]\nledger = { quantity = \"mass\", limit = 1 }\n", "8",
                    "unknown key `quantity`");
  expect_refused_at(six_lines + "[invariants]\nledger = { value = 1, limit = 1 }\n", "8", "start of the run");
  expect_refused_at(six_lines + "[invariants]\nledger = {}\n", "8", "no limit and would pass anything");
  expect_refused_at(six_lines + "[invariants]\nledger = \"little\"\n", "8", "limit");
  expect_refused_at(six_lines + "[invariants]\nbody_count = { limit = 1, reason = \"r\" }\n", "8",
                    "lacks the key `value`");
  expect_refused_at(six_lines + "[invariants]\noverlap = 1\n", "8", "reason");
  expect_refused_at(six_lines +
                        "[invariants]\noverlap = { value = 1, reference = { kind = \"bound\", function = "
                        "\"stated\" }, limit = 1, "
                        "reason = \"r\" }\n",
                    "8", "beside `reference`");
  expect_refused_at(six_lines + "[invariants]\nledger = { engine = \"tripoint\", gates = [{ limit = 1 }] }\n",
                    "8", "beside `gates`");
  expect_refused_at(metric + "[invariants]\nledger = { name = \"place\", limit = 1 }\n", "11", "two tables");
}

}  // namespace
}  // namespace tripoint::test
