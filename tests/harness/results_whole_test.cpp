// SPDX-License-Identifier: BSD-3-Clause
// Each field of results.json is written and read back: no two fields of this one hold the same, and none
// holds what an absent one is taken for.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/durable_file.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"

namespace tripoint {
namespace {

RunRow whole_run() {
  RunRow r;
  r.knobs = {0.01, 0.02, 2.5, 3.0, 4.0, JudgedMode::paper, 5, 6, 0.07};
  r.levels = {{{Axis::spacing, false, true}, 0.11}, {{Axis::walkers}, 12.0}};
  r.base = true;
  r.group = "the group";
  r.input = "material.water.viscosity=2";
  r.reason = "the reason";
  r.comparable = false;
  r.metrics["error"] = {0.13, {0.14, 0.15, 0.16, 0.17}, "the note", {0.18, 0.19}, {0.20, 0.21}};
  r.metrics["other"].value = not_a_number;
  r.cost = {22.0, 23.0, 24.0, 25.0, 26.0, 27.0, 28.0, 29.0, 30.0, 31.0, {32.0, 33.0}, "callgrind"};
  r.state_hash = "the state";
  r.time_step_bound = "the bound";
  r.folder = "runs/test/one/tripoint/paper";
  return r;
}

Results whole_results() {
  auto r = green();
  r.tool = {"1.2", "abc", "g++", "-O2", "a cpu", 34};
  r.command = "tripoint validate";
  r.profile = "commit";
  r.date = "2026-11-22";
  r.seed = 35;
  r.history = "history.jsonl";
  r.shard = "2/3";
  r.tag = "table1";
  r.filter_known = true;
  r.seed_given = true;
  r.what = {"cases/a", "cases/b"};
  r.only_engines = {"tripoint", "exact"};
  r.asked = {"bullet"};
  r.planned = {"test/one", "test/two"};
  auto& c = r.cases[0];
  c.kind = CaseKind::validation;
  c.requirement = "R1";
  c.claims = "it holds";
  c.file = "cases/test/one.toml";
  c.repeat = "tripoint validate one";
  c.expect = Expect::defect;
  c.tags = {"x", "y"};
  c.reference = {
      ReferenceKind::discrete_exact,
      "beam",
      "beam.csv",
      "a book",
      {{"a", 36.0}, {"b", true}, {"c", std::string("word")}, {"d", std::vector<double>{37.0, 38.0}}},
      39.0};
  c.metrics = {{"error", "position", "cube", "all", Norm::L2, {0.40, 0.41}, 0.5, 42.0, "mm", {}, {}}};
  Study s;
  s.axes = {Axis::spacing, true, false};
  s.levels = {0.2, 0.1};
  s.jitter = 0.43;
  s.seeds = 44;
  s.engine = "tripoint";
  s.mode = JudgedMode::corrected;
  s.expect = FitClass::asymptotic;
  s.order = 2.0;
  s.metric = "error";
  s.place = {"one.toml", 45, 0};
  c.studies = {s};
  Gate g;
  g.metric = "error";
  g.engine = "tripoint";
  g.mode = JudgedMode::not_paper;
  g.preset = "tuned";
  g.limit = 46.0;
  g.at_least = 47.0;
  g.band = {48.0, 49.0};
  g.level = 50.0;
  g.drift = 51.0;
  g.reason = "a reason";
  g.by = "somebody";
  g.date = "2026-11-21";
  g.place = {"one.toml", 52, 0};
  c.gates = {g};
  EngineRow e;
  e.name = "tripoint";
  e.version = "1.3";
  e.preset = "tuned";
  e.library_path = "/lib/x.so";
  e.library_hash = "the hash";
  e.required = true;
  e.refuses = "no gas";
  e.reason = "the engine's reason";
  e.runs = {whole_run()};
  c.engines = {e};
  c.equivalence = {{"a1", "b1", "error", 53.0, 54.0, 55.0, 56.0, 57.0, Equivalence::equivalent},
                   {"a2", "b2", "error", 58.0, 59.0, {}, 60.0, 61.0, Equivalence::no_margin}};
  c.ledger = {{"kinetic", 62.0}, {"heat", not_a_number}};
  c.timing_rounds = 63;
  c.timing_floor = 1.64;
  c.hashes = CaseHashes{"the scene", "the reference", {{"error", "its hash"}}, {}, {}};
  return r;
}

TEST(WholeResults, AreReadAsTheyWereWritten) {
  const TestFolder folder;
  auto r = whole_results();
  judge(r);
  const auto text = results_text(r);
  write_durably(folder / "results.json", text);
  auto stored = read_results(folder / "results.json");
  EXPECT_EQ(stored.verdict, r.verdict);
  EXPECT_EQ(stored.exit_code, r.exit_code);
  stored.verdict = CaseVerdict::interrupted;
  judge(stored);
  EXPECT_EQ(results_text(stored), text);
}

TEST(WholeResults, ARunIsReadAsItWasWritten) {
  const auto text = run_row_text(whole_run());
  EXPECT_EQ(run_row_text(read_run_row(text, "here")), text);
  for (const std::string bad : {"[1]", "{", "", "7"}) {
    try {
      (void)read_run_row(bad, "the place");
      ADD_FAILURE() << bad;
    } catch (const InputError& e) {
      EXPECT_STREQ(e.what(), "the place: holds no run of a results.json");
    }
  }
  EXPECT_THROW((void)read_run_row(std::string(100000, '['), "here"), InputError);
}

Results read_text(const std::string& text) {
  const TestFolder folder;
  write_text(folder / "r/results.json", text);
  return read_results(folder / "r/results.json");
}

TEST(WholeResults, WhatIsAbsentIsTakenForTheLeastThatItCanMean) {
  const auto r = read_text(
      R"({"format": 1, "only_engines": ["tripoint", 3],
     "cases": [{"engines": [{"runs": [{"metrics": {"error": {}}}]}], "metrics": [{}], "studies": [{}],
     "gates": [{}], "equivalence": [{}]}]})");
  EXPECT_EQ(r.seed, 1u);
  EXPECT_EQ(r.exit_code, exit_missing);
  EXPECT_EQ(r.asked, (std::vector<std::string>{"tripoint"}));  // an older file does not say who was asked for
  EXPECT_FALSE(r.interrupted || r.filter_known || r.seed_given);
  const auto& c = r.cases.at(0);
  EXPECT_EQ(c.expect, Expect::pass);
  EXPECT_FALSE(c.hashes.has_value());
  EXPECT_EQ(c.timing_rounds, 0);
  EXPECT_EQ(c.reference.uncertainty, 0.0);
  EXPECT_EQ(c.metrics.at(0).scale, 1.0);
  EXPECT_EQ(c.metrics[0].window, (std::array<double, 2>{0.0, 0.0}));
  EXPECT_EQ(c.studies.at(0).seeds, 1);
  EXPECT_EQ(c.studies[0].jitter, 0.0);
  EXPECT_FALSE(c.studies[0].order.has_value());
  const auto& g = c.gates.at(0);
  EXPECT_FALSE(g.limit || g.at_least || g.band || g.level || g.drift);
  EXPECT_EQ(g.place.line, 0);
  EXPECT_TRUE(std::isnan(c.equivalence.at(0).difference));
  EXPECT_FALSE(c.equivalence[0].margin.has_value());
  const auto& e = c.engines.at(0);
  EXPECT_FALSE(e.required);
  EXPECT_EQ(e.status, Status::error);
  EXPECT_EQ(e.reason, "the results give no status");
  const auto& run = e.runs.at(0);
  EXPECT_EQ(run.status, Status::error);
  EXPECT_EQ(run.reason, "the results give no status");
  EXPECT_FALSE(run.base);
  EXPECT_TRUE(run.comparable);
  EXPECT_EQ(run.knobs.threads, 1);
  EXPECT_EQ(run.knobs.seed, 1u);
  EXPECT_EQ(run.knobs.spacing + run.knobs.time_step + run.knobs.support_ratio + run.knobs.jitter, 0.0);
  EXPECT_FALSE(run.knobs.walkers || run.knobs.iterations);
  const auto& cost = run.cost;
  EXPECT_EQ(cost.cpu_s + cost.wall_s + cost.setup_cpu_s + cost.peak_bytes + cost.pairs + cost.steps +
                cost.iterations + cost.simulated_s + cost.particles + cost.instructions,
            0.0);
  const auto& m = run.metrics.at("error");
  EXPECT_TRUE(std::isnan(m.value));
  EXPECT_EQ(m.uncertainty.combined(), 0.0);
}

TEST(WholeResults, PartsOfAnotherKindAreNoValues) {
  const auto r = read_text(
      R"({"format": 1, "interrupted": true, "cases": [{"tags": ["a", 1], "hashes": {"scene": "s",
     "metrics": {"m": 5}}, "gates": [{"band": [1, 2, 3], "limit": "x"}, {"band": [1]}],
    "metrics": [{"window": [1]}], "reference": {"args": {"a": null}}, "engines": [{"status": "ok",
     "runs": [{"status": "ok", "metrics": {"a": {"value": 3, "finite": false}, "b": {"value": 3,
     "uncertainty": 7, "series": [1, "x"]}}}]}]}]})");
  EXPECT_TRUE(r.interrupted);
  const auto& c = r.cases.at(0);
  EXPECT_EQ(c.tags, (std::vector<std::string>{"a"}));
  EXPECT_EQ(c.hashes->metrics.at("m"), "");
  EXPECT_FALSE(c.gates[0].band || c.gates[0].limit || c.gates[1].band);
  EXPECT_EQ(c.metrics[0].window[0], 0.0);
  EXPECT_EQ(std::get<std::string>(c.reference.args.at("a")), "null");
  const auto& m = c.engines[0].runs[0].metrics;
  EXPECT_TRUE(std::isnan(m.at("a").value));
  EXPECT_EQ(m.at("b").value, 3.0);
  EXPECT_EQ(m.at("b").uncertainty.numerical, 0.0);
  EXPECT_EQ(m.at("b").series.at(0), 1.0);
  EXPECT_TRUE(std::isnan(m.at("b").series.at(1)));
}

/// The place and the word; an unknown word is never taken for another.
TEST(WholeResults, AnUnknownWordIsAnErrorThatSaysWhereItStands) {
  const auto why = [](const std::string& cases) {
    try {
      (void)read_text(R"({"format": 1, "cases": )" + cases + "}");
      return std::string("it was read");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  for (const auto& [cases, place] :
       {std::pair{
            R"([{"engines": [{"status": "ok"}, {"status": "ok", "runs": [{"status": "ok"},
     {"status": "fine"}]}]}])",
            "results.json: cases[0].engines[1].runs[1].status: `fine` is no status of a run"},
        std::pair{R"([{}, {"engines": [{"status": "OK"}]}])",
                  "results.json: cases[1].engines[0].status: `OK` is no status"},
        std::pair{R"([{"expect": "fail"}])", "cases[0].expect: `fail` is no expectation"},
        std::pair{R"([{"kind": "proof"}])", "cases[0].kind: `proof` is no kind of case"},
        std::pair{R"([{"reference": {"kind": "exact"}}])",
                  "cases[0].reference.kind: `exact` is no kind of reference"},
        std::pair{R"([{"studies": [{"expect": "flat"}]}])",
                  "cases[0].studies[0].expect: `flat` is no class of convergence"},
        std::pair{R"([{"studies": [{"axis": "spacing+walkers"}]}])",
                  "cases[0].studies[0].axis: `spacing+walkers` is no axis"},
        std::pair{R"([{"gates": [{"mode": "printed"}]}])", "cases[0].gates[0].mode: `printed` is no mode"},
        std::pair{R"([{"metrics": [{"norm": "L3"}]}])", "cases[0].metrics[0].norm: `L3` is no norm"},
        std::pair{R"([{"engines": [{"runs": [{"levels": {"space": 1}}]}]}])",
                  "cases[0].engines[0].runs[0].levels: `space` is no axis"},
        std::pair{R"([{"equivalence": [{"verdict": "same"}]}])",
                  "cases[0].equivalence[0].verdict: `same` is no verdict"}})
    EXPECT_NE(why(cases).find(place), std::string::npos) << why(cases);
  EXPECT_NE(why(R"([], "verdict": "GREEN")").find("verdict: `GREEN` is no verdict of a case"),
            std::string::npos);
}

TEST(WholeResults, ARefusedFileIsToldWhy) {
  const auto why = [](const std::string& text) {
    try {
      (void)read_text(text);
      return std::string("it was read");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_NE(why("[]").find("is not a JSON object"), std::string::npos);
  EXPECT_NE(why(R"({"format": 2, "cases": []})").find("has not \"format\": 1"), std::string::npos);
  EXPECT_NE(why(R"({"format": 1, "cases": {}})").find("has no list \"cases\""), std::string::npos);
  EXPECT_NE(why("{\"format\": 1, \"cases\": " + std::string(5000, '[') + "}").find("nests deeper than"),
            std::string::npos);
}

}  // namespace
}  // namespace tripoint
