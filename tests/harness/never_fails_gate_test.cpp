// SPDX-License-Identifier: BSD-3-Clause
// Ways in which a change of cases, baselines or files went green without a word; each one must be red, with a
// name.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/mutation/selftest_runs.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace {

/// A suite in a folder of its own, run on one fake engine that flies as it should, and accepted.
class Accepted {
 public:
  explicit Accepted(const std::string& more = "") : more_(more) {
    std::filesystem::create_directories(folder / "baselines");
    write(more);
    r = run("nothing");
    (void)accept(r, {}, {"2026-11-22", "abc", "a test"});
  }

  void write(const std::string& more, const std::string& from = "", const std::string& to = "") {
    auto text = flight_case(more);
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    write_text(file(), text);
  }

  Results run(const std::string& wrong) {
    SuiteOptions options;
    options.out = folder / "out";
    Results results =
        run_suite({read_case(file()).value}, {ask_engine(fake_engine(folder, wrong, "tripoint"))}, options);
    results.filter_known = true;
    results.what = {folder / "cases"};
    return results;
  }

  [[nodiscard]] std::string file() const { return folder / "cases/test/flight.toml"; }

  /// The case again with one text in the place of another, run and judged against what was accepted.
  std::vector<Remark> after(const std::string& from, const std::string& to) {
    write(more_, from, to);
    return baseline_remarks(run("nothing"));
  }

  TestFolder folder;
  Results r;

 private:
  std::string more_;
};

bool says(const std::vector<Remark>& list, const std::string& text, const std::string& word) {
  return std::any_of(list.begin(), list.end(), [&](const Remark& m) {
    return m.error && m.code == exit_missing && m.word == word && m.text.find(text) != std::string::npos;
  });
}

std::string all_of(const std::vector<Remark>& list) { return remarks_text(list); }

constexpr const char* two_sided =
    "[[gate]]\nmetric = \"travelled\"\nband = [0.1, 2.0]\nreason = \"it flies\"\n"
    "[[metric]]\nname = \"travelled\"\nquantity = \"position\"\nnorm = \"drift\"\nunit = \"m\"\n";

TEST(NeverFailsGate, IsGreenAsItWasAccepted) {
  Accepted suite(two_sided);
  EXPECT_EQ(suite.r.exit_code, exit_pass) << case_line(suite.r.cases.at(0));
  for (const auto& list : {baseline_remarks(suite.r), lost_case_remarks(suite.r), recheck_remarks(suite.r)})
    EXPECT_TRUE(list.empty()) << all_of(list);
}

TEST(NeverFailsGate, Way21ABandThatIsShiftedAtEqualWidthIsLoosened) {
  Accepted suite(two_sided);
  const auto list = suite.after("band = [0.1, 2.0]", "band = [0.2, 2.1]");
  EXPECT_TRUE(says(list, "its upper edge has moved from 2 to 2.1", "LOOSENED")) << all_of(list);
  EXPECT_TRUE(suite.after("band = [0.1, 2.0]", "band = [0.2, 1.9]").empty());
  EXPECT_EQ(verdict_word(exit_missing, suite.r, list), "LOOSENED");
}

TEST(NeverFailsGate, Way22ABandOfAnOlderBaselineIsReadFromItsWords) {
  Accepted suite(two_sided);
  const auto path = baseline_file(suite.file());
  auto b = read_baseline(path);
  for (auto& g : b.gates) {
    g.band.reset();
    g.limit.reset();
    g.measures.clear();
  }
  b.scene.clear();
  b.case_hash.clear();
  write_text(path, baseline_text(b));
  EXPECT_TRUE(says(suite.after("band = [0.1, 2.0]", "band = [0.2, 2.1]"), "its upper edge", "LOOSENED"));
}

TEST(NeverFailsGate, Way23AMetricThatMeasuresSomethingElseIsChanged) {
  for (const auto& [from, to] : {std::pair{"unit = \"m\"\n[[gate]]\nmetric = \"position\"",
                                           "unit = \"m\"\nscale = 100.0\n[[gate]]\nmetric = \"position\""},
                                 std::pair{"norm = \"max\"", "norm = \"final\""},
                                 std::pair{"norm = \"max\"", "norm = \"max\"\nwindow = [0.0, 0.1]"}}) {
    Accepted suite;
    const auto list = suite.after(from, to);
    EXPECT_TRUE(says(list, "its metric has changed", "CHANGED")) << to << "\n" << all_of(list);
  }
}

TEST(NeverFailsGate, Way24AnotherSceneOrReferenceIsChangedAndTextForPeopleIsNot) {
  Accepted suite;
  EXPECT_TRUE(says(suite.after("end_time = 0.5", "end_time = 0.05"), "its scene", "CHANGED"));
  EXPECT_TRUE(says(suite.after("source = \"the parabola\"", "source = \"the parabola\"\nuncertainty = 1.0"),
                   "its reference", "CHANGED"));
  EXPECT_TRUE(suite.after("claims = \"it flies\"", "claims = \"it flies as ever\" # a comment").empty());
  EXPECT_TRUE(suite.after("end_time = 0.5", "end_time = \"500 ms\"").empty());
}

TEST(NeverFailsGate, Way25AnEngineThatIsRequiredNoMoreIsChanged) {
  Accepted suite("[engines.tripoint]\nrequired = true\n");
  EXPECT_TRUE(says(suite.after("required = true", "required = false"), "tripoint was required", "CHANGED"));
}

TEST(NeverFailsGate, Way26ACaseThatIsDeletedOrTakenOffItsProfileIsGone) {
  Accepted suite;
  auto other = suite.r;
  write_text(suite.folder / "cases/test/second.toml", flight_case());
  other.cases[0].file = suite.folder / "cases/test/second.toml";
  other.cases[0].id = "test/second";
  suite.write("", "claims = \"it flies\"", "claims = \"it flies\"\nprofiles = [\"nightly\"]");
  EXPECT_TRUE(says(lost_case_remarks(other), "was accepted in the profile commit", "GONE"));
  std::filesystem::remove(suite.file());
  EXPECT_TRUE(says(lost_case_remarks(other), "its case", "GONE"));
  EXPECT_THROW((void)accept_removal({suite.folder / "cases/test/second.toml"}, {"", "", "why"}), InputError);
  EXPECT_NE(accept_removal({suite.file()}, {"", "", "it was doubled"}).find("REMOVED with 1 gates"),
            std::string::npos);
  EXPECT_TRUE(lost_case_remarks(other).empty());
}

TEST(NeverFailsGate, ACaseBesideTheFolderOfCasesSharesItsBaselinesAndLosesNone) {
  Accepted suite;
  auto beside = suite.r;
  beside.cases[0].file = suite.folder / "own.toml";
  beside.cases[0].id = "own";
  write_text(beside.cases[0].file, flight_case());
  EXPECT_TRUE(lost_case_remarks(beside).empty()) << "the baselines are of the cases in `cases`";
  std::filesystem::remove(suite.file());
  EXPECT_TRUE(says(lost_case_remarks(beside), "its case", "GONE")) << "it is nowhere";
}

TEST(NeverFailsGate, OnlyAWholeRunOfAProfileOwesAllItsCases) {
  Accepted suite;
  auto whole = suite.r;
  write_text(suite.folder / "cases/test/second.toml", flight_case());
  whole.cases[0].file = suite.folder / "cases/test/second.toml";
  whole.cases[0].id = "test/second";
  whole.filter_known = true;
  whole.profile = "commit";
  whole.what.clear();
  whole.tag.clear();
  whole.shard.clear();
  EXPECT_TRUE(says(lost_case_remarks(whole), "the results of that profile do not hold it", "GONE"));
  const auto none = [](Results r, auto change) {
    change(r);
    return lost_case_remarks(r).empty();
  };
  EXPECT_TRUE(none(whole, [](Results& r) { r.filter_known = false; }));
  EXPECT_TRUE(none(whole, [](Results& r) { r.what = {"cases/test"}; }));
  EXPECT_TRUE(none(whole, [](Results& r) { r.tag = "table1"; }));
  EXPECT_TRUE(none(whole, [](Results& r) { r.shard = "1/2"; }));
  EXPECT_TRUE(none(whole, [](Results& r) { r.profile.clear(); }));
  EXPECT_TRUE(none(whole, [](Results& r) { r.profile = "nightly"; }));
}

TEST(NeverFailsGate, Way27AnotherCopyOfTheBaselinesJudgesAChangeThatBringsItsOwn) {
  Accepted suite;
  std::filesystem::copy(suite.folder / "baselines", suite.folder / "theirs",
                        std::filesystem::copy_options::recursive);
  suite.write("", "limit = 1e-10", "limit = 1e-3");
  const auto r = suite.run("nothing");
  (void)accept(r, {}, {"2026-11-22", "abc", "their own reason"});
  EXPECT_TRUE(baseline_remarks(r).empty());
  EXPECT_TRUE(says(baseline_remarks(r, false, suite.folder / "theirs"),
                   "its upper edge has moved from 1e-10 to 0.001", "LOOSENED"));
}

TEST(NeverFailsGate, Way28AnOptionalEngineThatCrashesOrRefusesWhatItOnceRanIsRed) {
  const std::string optional =
      "[engines.tripoint]\nrequired = false\n[[gate]]\nmetric = \"position\"\nengine = \"tripoint\"\nlimit = "
      "1e-10\nreason = "
      "\"round-off\"\n";
  for (const char* wrong : {"is killed", "leaves no result", "stops early"}) {
    Accepted suite(optional);
    EXPECT_EQ(suite.run(wrong).exit_code, exit_missing) << wrong;
  }
  Accepted suite(optional);
  auto refused = suite.run("refuses");
  refused.cases[0].exit_code = exit_pass;  // another engine's gates are green
  EXPECT_TRUE(says(baseline_remarks(refused), "judges nothing any more", "GONE"));
  auto missing = suite.run("nothing");
  missing.cases[0].engines[0].status = Status::missing;
  missing.cases[0].engines[0].runs.clear();
  missing.cases[0].engines[0].gates.clear();
  missing.cases[0].exit_code = exit_pass;
  EXPECT_TRUE(baseline_remarks(missing).empty());
  EXPECT_EQ(accepted_but_absent(missing).at("tripoint"), 2);
}

TEST(NeverFailsGate, Way29ResultsThatAreNotThoseOfTheCaseAreNotJudged) {
  Accepted suite(two_sided);
  const auto red = [&](const std::string& text, const auto& spoil) {
    auto r = suite.r;
    spoil(r.cases[0]);
    judge(r);
    const auto list = recheck_remarks(r);
    EXPECT_TRUE(says(list, text, "CHANGED")) << text << "\n" << all_of(list);
  };
  red("the gate on position, limit 1e-10, is not in them", [](CaseResult& c) { c.gates[0].limit = 1.0; });
  red("the gate on travelled", [](CaseResult& c) { c.gates.pop_back(); });
  red("the metric position has another", [](CaseResult& c) { c.metrics[0].scale = 1e6; });
  red("is not in them", [](CaseResult& c) { c.metrics.pop_back(); });
  red("tripoint has no row in them", [](CaseResult& c) { c.engines[0].name = "another"; });
  red("tripoint is required", [](CaseResult& c) { c.engines[0].required = false; });
  red("the run corrected of tripoint",
      [](CaseResult& c) { c.engines[0].runs[0].folder = "runs/test/flight/tripoint/other"; });
  red("has no value of travelled", [](CaseResult& c) { c.engines[0].runs[0].metrics.erase("travelled"); });
  red("is not the max of its series",
      [](CaseResult& c) { c.engines[0].runs[0].metrics.at("position").value = 1e-11; });
  red("the reference is another", [](CaseResult& c) { c.reference.uncertainty = 1.0; });
  red("expects", [](CaseResult& c) { c.expect = Expect::diverges; });
  auto r = suite.r;
  write_text(suite.folder / "cases/test/second.toml", flight_case());
  EXPECT_TRUE(says(recheck_remarks(r), "is not in them: validate again", "CHANGED"));
  std::filesystem::remove(suite.file());
  EXPECT_TRUE(says(recheck_remarks(r), "cannot be read again", "CHANGED"));
}

TEST(NeverFailsGate, Way36ABaselineThatWasEditedByHandIsRed) {
  Accepted suite;
  const auto path = baseline_file(suite.file());
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  for (auto at = text.find("1e-10"); at != std::string::npos; at = text.find("1e-10", at + 1))
    text.replace(at, 5, "1e-03");
  write_text(path, text);
  EXPECT_TRUE(says(baseline_remarks(suite.r), "edited by hand", "CHANGED"));
}

TEST(NeverFailsGate, Way37OtherDataBehindAReferenceIsAnotherReference) {
  const TestFolder folder;
  auto text = flight_case();
  const std::string formula = "kind = \"analytic\"\nfunction = \"ballistic\"";
  text.replace(text.find(formula), formula.size(), "kind = \"experiment\"\nfile = \"flight.ref.csv\"");
  write_text(folder / "cases/test/flight.toml", text);
  write_text(folder / "cases/test/flight.ref.csv", "time,position\n0.0,1.0\n");
  const auto before = case_hashes(folder / "cases/test/flight.toml");
  ASSERT_TRUE(before);
  write_text(folder / "cases/test/flight.ref.csv", "time,position\n0.0,2.0\n");
  const auto after = case_hashes(folder / "cases/test/flight.toml");
  ASSERT_TRUE(after);
  EXPECT_NE(after->reference, before->reference);
  EXPECT_EQ(after->scene, before->scene);
}

/// Edited to be easier, validated and put back: limits, metrics and values are then those of the case.
TEST(NeverFailsGate, Way53ASceneThatWasEasierWhenItRanIsSeenThoughItIsPutBack) {
  for (const auto& [from, to] : {std::pair{"end_time = 0.5", "end_time = 0.05"},
                                 std::pair{"velocity = [1.0, 0.0, 2.0]", "velocity = [0.0, 0.0, 0.0]"},
                                 std::pair{"density = 1000.0", "density = 1.0"}}) {
    Accepted suite;
    suite.write("", from, to);
    write_text(suite.folder / "results.json", results_text(suite.run("nothing")));
    const auto easier = read_results(suite.folder / "results.json");
    EXPECT_TRUE(recheck_remarks(easier).empty()) << all_of(recheck_remarks(easier));
    suite.write("");
    EXPECT_TRUE(says(recheck_remarks(easier), "the scene was another", "CHANGED"))
        << to << "\n"
        << all_of(recheck_remarks(easier));
  }
}

TEST(NeverFailsGate, Way54AMetricWhoseOwnReferenceWasAnotherIsSeenThoughItIsPutBack) {
  const std::string own =
      "[[metric]]\nname = \"late\"\nquantity = \"position\"\nnorm = \"final\"\nunit = \"m\"\nreference = { "
      "kind = \"analytic\", "
      "function = \"ballistic\", source = \"the parabola\", uncertainty = 0.0 }\n";
  Accepted suite(own);
  suite.write(own, "uncertainty = 0.0", "uncertainty = 1.0");
  write_text(suite.folder / "results.json", results_text(suite.run("nothing")));
  const auto easier = read_results(suite.folder / "results.json");
  suite.write(own);
  EXPECT_TRUE(says(recheck_remarks(easier), "the metric late was another", "CHANGED"))
      << all_of(recheck_remarks(easier));
}

TEST(NeverFailsGate, Way34TheRedRowOfThePrintedFormDoesNotStandForTheCorrectedOne) {
  auto r = green();
  auto paper = engine(r).runs[0];
  engine(r).runs[0].knobs.mode = JudgedMode::corrected;
  paper.knobs.mode = JudgedMode::paper;
  paper.group = "paper";
  paper.metrics["error"].value = 5.0;
  engine(r).runs.push_back(paper);
  r.cases[0].gates[0].mode = JudgedMode::corrected;
  r.cases[0].gates[0].limit = 1e9;
  auto printed = limit("error", 0.1);
  printed.mode = JudgedMode::paper;
  r.cases[0].gates.push_back(printed);
  judge(r);
  const auto& c = r.cases[0];
  EXPECT_EQ(decisive_mode(c, "error", "fluid.state"), JudgedMode::corrected);
  EXPECT_FALSE(look(c, "error", JudgedMode::corrected).red);
  EXPECT_TRUE(look(c, "error", JudgedMode::paper).red);
  EXPECT_EQ(decisive_mode(c, "error", "fluid.paper.state"), JudgedMode::paper);
}

TEST(NeverFailsGate, Way35ADefectWhoseOwnCaseIsGoneIsAProblem) {
  EngineEntry solver;
  solver.defects = {{"rigid.gravity", "gravity times 1 + size", "rigid/ballistic"}};
  Case other;
  other.id = "rigid/other";
  other.defects = {{"rigid.gravity", 0.01, {}, {"position"}, {}}};
  const auto problems = registry_problems({other}, solver, true);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("names rigid/ballistic"), std::string::npos) << problems[0];
  other.id = "rigid/ballistic";
  EXPECT_TRUE(registry_problems({other}, solver, true).empty());
}

}  // namespace
}  // namespace tripoint
