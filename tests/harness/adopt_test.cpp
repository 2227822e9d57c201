// SPDX-License-Identifier: BSD-3-Clause
// Gates that adopting an engine writes, from values made by hand.
#include "validation/publish/adopt.hpp"

#include <gtest/gtest.h>

#include "validation/case/case.hpp"
#include "validation/judge/apply_gate.hpp"

namespace tripoint {
namespace {

constexpr double round_off = 1e-11;

TEST(Adopt, AnErrorGetsRoomToBothSides) {
  const auto g = adopted_gate("angle", {{0.04, 0.04}}, 1.5, round_off);
  ASSERT_TRUE(g.band);
  EXPECT_NEAR((*g.band)[0], 0.04 / 1.5, 1e-12);
  EXPECT_NEAR((*g.band)[1], 0.06, 1e-12);
  EXPECT_EQ(verdict_of(g, 0.04, 0.0), Verdict::pass);
  EXPECT_EQ(verdict_of(g, 0.061, 0.0), Verdict::fail);
  EXPECT_EQ(verdict_of(g, 0.02, 0.0), Verdict::fail);
}

TEST(Adopt, ANegativeValueKeepsItsSign) {
  const auto g = adopted_gate("energy", {{-0.06, -0.06}}, 2.0, round_off);
  EXPECT_NEAR((*g.band)[0], -0.12, 1e-12);
  EXPECT_NEAR((*g.band)[1], -0.03, 1e-12);
}

TEST(Adopt, NoiseAndStatedUncertaintyWidenTheBand) {
  const auto quiet = adopted_gate("angle", {{0.04, 0.04, 0.04}}, 1.5, round_off);
  const auto noisy = adopted_gate("angle", {{0.04, 0.041, 0.039}}, 1.5, round_off);
  const auto stated = adopted_gate("angle", {{0.04, 0.04, 0.04}, 0.001}, 1.5, round_off);
  EXPECT_NEAR((*noisy.band)[1] - (*quiet.band)[1], 4.0 * 0.001, 1e-9);
  EXPECT_NEAR((*stated.band)[1] - (*quiet.band)[1], 2.0 * 0.001, 1e-12);
}

TEST(Adopt, RoundOffMayBecomeSmaller) {
  const auto g = adopted_gate("position", {{3e-15, 3e-15}}, 1.5, round_off);
  EXPECT_FALSE(g.band);
  EXPECT_EQ(g.limit, 1e-10);
  EXPECT_EQ(adopted_gate("position", {{2e-6, 2e-6}}, 1.5, 1e-5).limit, 6e-6);  // single precision
}

TEST(Adopt, NoiseAboveTheValueIsSaidAndNotGivenAsRoom) {
  EXPECT_EQ(noise_exceeds_value("angle", {{0.04, 0.041, 0.039}}, round_off), "");
  EXPECT_NE(
      noise_exceeds_value("angle", {{0.04, 0.09, 0.0}}, round_off).find("noise of angle exceeds its value"),
      std::string::npos);
  EXPECT_NE(noise_exceeds_value("angle", {{0.04, 0.04}, 0.03}, round_off), "");  // stated by the run itself
  EXPECT_NE(noise_exceeds_value("angle", {{-0.04, 0.04}}, round_off), "");       // a mean of zero has no size
  EXPECT_EQ(noise_exceeds_value("angle", {{1e-14, 3e-14}}, round_off), "");      // round-off
}

const char* const source = R"(# A throw onto a floor.
format = 1
engines.all.settings = { friction = 0.3, restitution = 0.5 }
engines.stone = { preset = ["default", "fine"], settings = { iterations = 40.0 }, refuses = "nothing" }
engines.tripoint.required = true

[case]
title = "A throw"
requirement = "R"
claims = "ours is exact"
profiles = ["commit", "acceptance"]
modes = ["corrected", "paper"]

[scene]
end_time = 1.0

[[metric]]
name = "position"
quantity = "position"

[["metric"]]
name = "heat"
quantity = "temperature"

[[study]]
axis = "time_step"
levels = [0.02, 0.01]
engine = "bullet"

[[study]]
axis = "time_step"
levels = [0.02, 0.01]
mode = "not paper"

[[study]]
axis = "spacing"
levels = [0.2, 0.1]
engine = "stone"

[[gate]]
metric = "position"
limit = 0.05
reason = "of any"

[[defect]]
name = "rigid.gravity"
size = 0.01
)";

AdoptedCase adopted() {
  AdoptedRow row{"default", Status::ok, "", {}, {}};
  auto g = adopted_gate("position", {{0.04, 0.04}}, 1.5, round_off);
  g.engine = "stone";
  g.level = 0.01;
  g.date = "2026-11-22";
  row.gates = {g};
  auto fine = row;
  fine.preset = "fine";
  return {"rigid/throw", "throw.toml", {row, fine}, {}};
}

EngineEntry stone() {
  EngineEntry e;
  e.name = "stone";
  e.version = "2";
  e.presets = {"default", "fine", "rough"};
  return e;
}

std::string text_of(const AdoptedCase& c, const std::string& despite = {}) {
  return adopted_text(parse_toml(source, "throw.toml"), "# A throw onto a floor.\n", c, stone(), despite);
}

TEST(Adopt, TheWrittenCaseKeepsTheSceneWhole) {
  const auto text = text_of(adopted());
  for (const char* kept :
       {"# A throw onto a floor.", "id = \"rigid/throw\"", "[scene]", "end_time = 1.0", "name = \"position\"",
        "name = \"heat\"", "[engines.all]", "friction = 0.3", "restitution = 0.5", "[engines.stone]",
        "iterations = 40.0", "required = true", "adopted = true", "preset = [\"default\", \"fine\"]",
        "axis = \"time_step\"", "axis = \"spacing\"", "level = 0.01", "band = [0.0266667, 0.06]"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << "\n" << text;
  for (const char* gone :
       {"bullet", "modes", "ours is exact", "rigid.gravity", "of any", "not paper", "acceptance", "refuses"})
    EXPECT_EQ(text.find(gone), std::string::npos) << gone << "\n" << text;
}

TEST(Adopt, FindingsRefuseTheCaseUnlessAReasonExcusesThem) {
  auto c = adopted();
  EXPECT_TRUE(c.refused_by("").empty());
  c.rows[0].findings.push_back({1, "position fails a limit", true});
  EXPECT_EQ(c.refused_by(""), std::set<int>{1});
  EXPECT_TRUE(c.refused_by("it is known").empty());
  c.rows[1].findings.push_back({4, "heat has no finite value", false});
  EXPECT_EQ(c.refused_by("it is known"), std::set<int>{4});
  EXPECT_EQ(c.all_findings()[1].text, "preset fine: heat has no finite value");
}

TEST(Adopt, TheReasonToAdoptWhatFailsStandsInTheCase) {
  auto c = adopted();
  EXPECT_EQ(text_of(c, "nobody asks").find("nobody asks"), std::string::npos) << "nothing of it fails";
  c.rows[0].findings.push_back({1, "position fails a limit", true});
  const auto text = text_of(c, "the next release\x1b[2J has it");
  EXPECT_NE(text.find("# Despite: position fails a limit"), std::string::npos) << text;
  EXPECT_NE(text.find("adopted despite what it fails: the next release?[2J has it"), std::string::npos)
      << text;
}

TEST(Adopt, FilesThatTheCaseNamesGoWithIt) {
  const auto document = parse_toml(
      "body = [{ shape = { kind = \"mesh\", file = \"a.obj\" } }]\nreference.file = \"b.ref.csv\"\n",
      "x.toml");
  EXPECT_EQ(files_named_in(document), (std::set<std::string>{"a.obj", "b.ref.csv"}));
}

Case case_of_two_engines() {
  Case value;
  value.engines = {{"all", false, false, {}, {{"friction", 0.3}}},
                   {"bullet", true, false, {}, {}},
                   {"stone", false, false, {"fine"}, {{"steps", 2.0}}}};
  Gate any, own, paper;
  own.engine = "stone";
  paper.mode = JudgedMode::paper;
  value.gates = {any, own, paper};
  return value;
}

TEST(Adopt, TheCaseIsMeasuredBySettingsPresetsAndLimitsOfTheSource) {
  const auto value = case_to_adopt(case_of_two_engines(), stone());
  ASSERT_EQ(value.engines.size(), 3u);
  EXPECT_EQ(value.engines[0].name, "all");
  EXPECT_EQ(value.engines[1].name, "stone");
  EXPECT_EQ(value.engines[1].presets, std::vector<std::string>{"fine"});
  EXPECT_EQ(value.engines[1].settings.count("steps"), 1u);
  ASSERT_EQ(value.gates.size(), 1u) << "the limit that holds for any engine";
  auto other = stone();
  other.name = "rock";
  EXPECT_EQ(case_to_adopt(case_of_two_engines(), other).engines[1].presets, other.presets)
      << "a case that lists none is run in all";
}

}  // namespace
}  // namespace tripoint
