// SPDX-License-Identifier: BSD-3-Clause
// Results against the file of their case: one part after another is changed in the results, and each change
// is named, alone.
#include <gtest/gtest.h>

#include <functional>

#include "core/errors.hpp"
#include "fakes.hpp"
#include "judged.hpp"
#include "validation/baseline/gate_verdict.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/references/experiment.hpp"
#include "validation/run/plan_runs.hpp"

namespace tripoint {
namespace {

constexpr const char* more =
    "[[metric]]\nname = \"late\"\nquantity = \"velocity\"\nnorm = \"final\"\nunit = \"m/s\"\n"
    "[[gate]]\nmetric = \"late\"\nband = [0.5, 2.0]\nmode = \"corrected\"\ndrift = 0.1\nreason = \"it "
    "flies\"\n"
    "[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.05]\nexpect = \"plateau\"\norder = 2.0\nmetric = "
    "\"position\"\n"
    "[engines.other]\npreset = [\"default\", \"tuned\"]\n";

/// Results as the suite writes them: a row for each engine that is planned, a run for each that it plans.
Results results_of(const Case& file) {
  CaseResult c;
  c.id = file.id;
  c.file = file.file;
  c.expect = file.expect;
  c.reference = with_source_of_file(file.reference);
  c.metrics = file.metrics;
  c.gates = file.gates;
  c.studies = file.studies;
  c.hashes = case_hashes(file.file);
  for (const auto& plan : plan_runs(file, {}, {})) {
    EngineRow e;
    e.name = plan.name;
    e.preset = plan.preset;
    e.required = plan.required;
    for (const auto& p : plan.runs) {
      RunRow run;
      run.group = p.group;
      run.folder = "runs/test/flight/" + plan.name + "/" +
                   (plan.preset == "default" ? "" : plan.preset + "-") + p.label;
      for (const auto& m : file.metrics) run.metrics[m.name] = {2.0, {}, {}, {0.0, 0.5}, {1.0, 2.0}};
      e.runs.push_back(run);
    }
    c.engines.push_back(e);
  }
  Results r;
  r.cases = {c};
  return r;
}

struct Flown {
  TestFolder folder;
  Case file = read_flight_case(folder, more);
  Results r = results_of(file);
  EngineRow& row(const std::string& name) {
    return *std::find_if(r.cases[0].engines.begin(), r.cases[0].engines.end(),
                         [&](const auto& e) { return e.name == name; });
  }
};

using Change = std::function<void(CaseResult&)>;

TEST(RecheckParts, ResultsOfTheirOwnCaseSayNothing) {
  Flown f;
  const auto list = recheck_remarks(f.r);
  EXPECT_TRUE(list.empty()) << remarks_text(list);
}

TEST(RecheckParts, EachPartThatIsAnotherIsNamedAlone) {
  const std::string another =
                        "the metric position has another quantity, norm, body, place, window, scale or unit",
                    gate = "the gate on position, limit 1e-10, is not in them", held = "they hold a gate on ",
                    study = "the study over spacing is not in them", reference = "the reference is another";
  const std::vector<std::pair<std::vector<std::string>, Change>> table{
      {{"expects \"diverges\", and the file says \"pass\""},
       [](CaseResult& c) { c.expect = Expect::diverges; }},
      {{"the scene was another when it was run"}, [](CaseResult& c) { c.hashes->scene += "x"; }},
      {{"the reference, or its data, were others when it was run"},
       [](CaseResult& c) { c.hashes->reference += "x"; }},
      {{"the metric late was another when it was run"},
       [](CaseResult& c) { c.hashes->metrics["late"] += "x"; }},
      {{}, [](CaseResult& c) { c.hashes->metrics.clear(); }},
      {{}, [](CaseResult& c) { c.hashes.reset(); }},
      {{reference}, [](CaseResult& c) { c.reference.kind = ReferenceKind::mms; }},
      {{reference}, [](CaseResult& c) { c.reference.function = "resting"; }},
      {{reference}, [](CaseResult& c) { c.reference.file = "other.csv"; }},
      {{reference}, [](CaseResult& c) { c.reference.args["x"] = 1.0; }},
      {{reference}, [](CaseResult& c) { c.reference.uncertainty = 0.1; }},
      {{another}, [](CaseResult& c) { c.metrics[0].quantity = "velocity"; }},
      {{another}, [](CaseResult& c) { c.metrics[0].norm = Norm::final; }},
      {{another}, [](CaseResult& c) { c.metrics[0].body = "cube"; }},
      {{another}, [](CaseResult& c) { c.metrics[0].at = "all"; }},
      {{another}, [](CaseResult& c) { c.metrics[0].scale = 2.0; }},
      {{another}, [](CaseResult& c) { c.metrics[0].unit = "mm"; }},
      {{another},
       [](CaseResult& c) {
         c.metrics[0].window = {0.0, 0.1};
       }},
      {{"the metric late is not in them"}, [](CaseResult& c) { c.metrics.pop_back(); }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].metric = "late"; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].engine = "other"; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].mode = JudgedMode::paper; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].preset = "tuned"; }},
      {{gate, held + "position, limit 1, that the file does not"},
       [](CaseResult& c) { c.gates[0].limit = 1.0; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].at_least = 1.0; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].level = 0.1; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].drift = 0.1; }},
      {{gate, held}, [](CaseResult& c) { c.gates[0].date = "2026-11-22"; }},
      {{"the gate on late, band 0.5 to 2, is not in them", held},
       [](CaseResult& c) {
         c.gates[1].band = {0.5, 2.5};
       }},
      {{held + "late, band 0.5 to 2, that"}, [](CaseResult& c) { c.gates.push_back(c.gates[1]); }},
      {{"the gate on late"}, [](CaseResult& c) { c.gates.pop_back(); }},
      {{study}, [](CaseResult& c) { c.studies.clear(); }},
      {{study}, [](CaseResult& c) { c.studies[0].axes = {Axis::time_step}; }},
      {{study}, [](CaseResult& c) { c.studies[0].levels[1] = 0.025; }},
      {{study}, [](CaseResult& c) { c.studies[0].jitter = 0.1; }},
      {{study}, [](CaseResult& c) { c.studies[0].seeds = 2; }},
      {{study}, [](CaseResult& c) { c.studies[0].engine = "other"; }},
      {{study}, [](CaseResult& c) { c.studies[0].mode = JudgedMode::paper; }},
      {{study}, [](CaseResult& c) { c.studies[0].expect = FitClass::asymptotic; }},
      {{study}, [](CaseResult& c) { c.studies[0].order = 1.0; }},
      {{study}, [](CaseResult& c) { c.studies[0].metric = "late"; }},
  };
  int k = 0;
  for (const auto& [texts, change] : table) {
    Flown f;
    change(f.r.cases[0]);
    const auto list = recheck_remarks(f.r);
    ASSERT_EQ(list.size(), texts.size()) << k << "\n" << remarks_text(list);
    for (std::size_t n = 0; n < texts.size(); ++n) {
      EXPECT_EQ(list[n].text.find("the results are not of this case: " + texts[n]), 0u)
          << k << " " << list[n].text;
      EXPECT_TRUE(list[n].error && list[n].code == exit_missing && list[n].word == "CHANGED" &&
                  list[n].title == "test/flight")
          << k;
    }
    ++k;
  }
}

TEST(RecheckParts, PointAtTheLineOfTheFileOrAtItsFirst) {
  Flown f;
  f.r.cases[0].gates.pop_back();
  f.r.cases[0].expect = Expect::diverges;
  const auto list = recheck_remarks(f.r);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].place.file, f.file.file);
  EXPECT_EQ(list[0].place.line, 1);
  EXPECT_EQ(list[1].place.line, f.file.gates[1].place.line);
  EXPECT_TRUE(std::isinf(list[1].excess));
}

TEST(RecheckParts, AFileOfAnotherCaseEndsTheComparison) {
  Flown f;
  f.r.cases[0].id = "test/other";
  f.r.cases[0].expect = Expect::diverges;
  const auto list = recheck_remarks(f.r);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NE(list[0].text.find("is that of test/flight"), std::string::npos);
}

TEST(RecheckParts, EnginesAndRunsThatAreNotThereAreNamed) {
  const auto only = [](const std::string& text, const std::function<void(Flown&)>& change) {
    Flown f;
    change(f);
    const auto list = recheck_remarks(f.r);
    ASSERT_EQ(list.size(), text.empty() ? 0u : 1u) << text << "\n" << remarks_text(list);
    if (!text.empty()) {
      EXPECT_EQ(list[0].text, "the results are not of this case: " + text);
    }
  };
  only("exact has no row in them", [](Flown& f) { f.row("exact").name = "stranger"; });
  only("other (tuned) has no row in them", [](Flown& f) {
    f.r.cases[0].engines.erase(std::find_if(f.r.cases[0].engines.begin(), f.r.cases[0].engines.end(),
                                            [](const auto& e) { return e.preset == "tuned"; }));
  });
  only("", [](Flown& f) {
    f.row("exact").preset = "its own";
    f.row("exact").status = Status::missing;
  });  // the case names no preset of it
  only("tripoint is required, and they say that it is not",
       [](Flown& f) { f.row("tripoint").required = false; });
  only("", [](Flown& f) { f.row("exact").required = true; });
  only("the run corrected-spacing=0.05 of tripoint is not in them",
       [](Flown& f) { f.row("tripoint").runs.pop_back(); });
  only("", [](Flown& f) {
    f.row("tripoint").status = Status::missing;
    f.row("tripoint").runs.clear();
  });
  only("", [](Flown& f) {
    f.r.only_engines = {"tripoint"};
    std::erase_if(f.r.cases[0].engines, [](const auto& e) { return e.name != "tripoint"; });
  });
}

TEST(RecheckParts, ARunOfASeedIsLookedForOnlyWhereTheSeedWasGiven) {
  TestFolder folder;
  auto text = flight_case("[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.05]\njitter = 0.1\nseeds = 2\n");
  write_text(folder / "cases/test/flight.toml", text);
  const auto file = read_case(folder / "cases/test/flight.toml").value;
  auto r = results_of(file);
  r.seed = 7;
  EXPECT_TRUE(recheck_remarks(r).empty()) << remarks_text(recheck_remarks(r));
  r.seed_given = true;  // the runs are then those of seed 8
  EXPECT_FALSE(recheck_remarks(r).empty());
}

TEST(RecheckParts, AValueIsTheNormOfItsSeriesToRoundOff) {
  const auto remark = [](const std::function<void(RunRow&)>& change) {
    Flown f;
    change(f.row("tripoint").runs[0]);
    const auto list = recheck_remarks(f.r);
    EXPECT_LE(list.size(), 1u) << remarks_text(list);
    return list.empty() ? std::string() : list[0].text.substr(34);
  };
  const auto with = [](const std::string& metric, double value) {
    return [=](RunRow& run) { run.metrics.at(metric).value = value; };
  };
  EXPECT_EQ(remark(with("position", 2.0)), "");
  EXPECT_EQ(remark(with("position", 2.0 + 1.9e-9)), "");  // 1e-9 of the value
  EXPECT_EQ(remark(with("position", 2.0 - 1.9e-9)), "");
  EXPECT_EQ(remark(with("position", 2.5)),
            "2.5 of position in tripoint corrected is not the max of its series, 2");
  EXPECT_EQ(remark(with("position", -2.0)),
            "-2 of position in tripoint corrected is not the max of its series, 2");
  EXPECT_NE(remark(with("position", 2.0 + 2.1e-9)), "");
  EXPECT_NE(remark(with("position", 2.0 - 2.1e-9)), "");
  EXPECT_EQ(remark(with("late", 2.5)), "2.5 of late in tripoint corrected is not the final of its series, 2");
  EXPECT_EQ(remark(with("position", std::nan(""))), "");  // fails by itself
  EXPECT_EQ(remark([](RunRow& run) { run.metrics.erase("late"); }),
            "tripoint has no value of late in its run corrected");
  EXPECT_EQ(remark([](RunRow& run) {
              run.metrics.erase("late");
              run.status = Status::killed;
            }),
            "");
  EXPECT_EQ(remark([](RunRow& run) {
              run.metrics.at("late").series.clear();
              run.metrics.at("late").value = 9.0;
            }),
            "");  // nothing to compare with
}

TEST(RecheckSelection, OnlyAWholeRunOfAFolderOwesItsOtherCases) {
  Flown f;
  write_text(f.folder / "cases/test/second.toml", flight_case());
  EXPECT_TRUE(recheck_remarks(f.r).empty());
  f.r.filter_known = true;
  f.r.what = {f.folder / "cases"};
  auto list = recheck_remarks(f.r);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].title, "test/second");
  EXPECT_EQ(list[0].text, "belongs to these results and is not in them: validate again");
  EXPECT_TRUE(list[0].error && list[0].code == exit_missing && list[0].word == "CHANGED");
  f.r.shard = "1/2";
  EXPECT_TRUE(recheck_remarks(f.r).empty());
  f.r.shard.clear();
  f.r.what = {f.folder / "nowhere"};
  list = recheck_remarks(f.r);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].title, "the results");
  std::filesystem::remove(f.file.file);
  f.r.filter_known = false;
  list = recheck_remarks(f.r);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].text.find("the case cannot be read again: "), 0u);
  EXPECT_EQ(list[0].place.line, 1);
}

TEST(GateVerdictParts, AFolderOfBaselinesMustHoldOne) {
  Flown f;
  const auto& folder = f.folder;
  const auto why = [&](const std::string& baselines) {
    try {
      (void)gate_verdict(f.r, baselines);
      return std::string("taken");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_NE(why(folder / "none").find("is no folder"), std::string::npos);
  write_text(folder / "empty/sub/readme.md", "");
  EXPECT_NE(why(folder / "empty").find("holds no baseline"), std::string::npos);
  write_text(folder / "empty/sub/one.toml", "format = 1\ncase = \"sub/one\"\n");
  EXPECT_EQ(why(folder / "empty"), "taken");
}

TEST(GateVerdictParts, PartsAndChosenCasesAreSaidAndTurnNothingRed) {
  const auto said = [](const Results& r, const std::string& text) {
    const auto list = gate_verdict(r).remarks;
    return std::count_if(list.begin(), list.end(), [&](const Remark& m) {
      return m.text.find(text) != std::string::npos && !m.error && m.code == 0;
    });
  };
  Flown f;
  auto& r = f.r;
  EXPECT_EQ(said(r, "are part"), 0);
  EXPECT_EQ(said(r, "are of chosen cases"), 1);
  r.shard = "2/3";
  EXPECT_EQ(said(r, "are part 2/3 of a suite"), 1);
  r.shard = "1/1";
  EXPECT_EQ(said(r, "are part"), 0);
  r.filter_known = true;
  r.what = {f.folder / "cases"};
  EXPECT_EQ(said(r, "are of chosen cases"), 0);
  r.filter_known = false;
  r.cases.clear();
  EXPECT_EQ(said(r, "are of chosen cases"), 0);
}

TEST(GateVerdictParts, TheCodeIsThatOfTheWorstErrorAndNotOfAWarning) {
  GateVerdict verdict;
  Results r = green();
  add_remarks(verdict, r,
              {{false, exit_diverged, {}, "a", "b", 1.0, {}}, {true, exit_cost, {}, "a", "b", 1.0, {}}});
  EXPECT_EQ(verdict.code, exit_cost);
  EXPECT_EQ(verdict.word, "COST REGRESSION");
  add_remarks(verdict, r, {{true, exit_fail, {}, "a", "b", 1.0, {}}});
  EXPECT_EQ(verdict.code, exit_fail);
  EXPECT_EQ(verdict.remarks.size(), 3u);
  r.exit_code = exit_diverged;
  add_remarks(verdict, r, {});
  EXPECT_EQ(verdict.code, exit_diverged);
}

}  // namespace
}  // namespace tripoint
