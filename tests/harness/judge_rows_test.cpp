// SPDX-License-Identifier: BSD-3-Clause
// The judge row by row: what becomes of each status and each gate, and the words that it says.
#include <gtest/gtest.h>

#include <cmath>

#include "fakes.hpp"
#include "judged.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/judge/remarks.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

// --- who was asked for

EngineRow stone(Status status, std::vector<Status> runs = {}, bool judged = false) {
  EngineRow e;
  e.name = "stone";
  e.status = status;
  e.reason = status == Status::ok ? "" : "its reason";
  for (const auto s : runs) {
    e.runs.emplace_back();
    e.runs.back().status = s;
    e.runs.back().reason = s == Status::ok ? "" : "its reason";
  }
  if (judged) {
    e.gates.resize(1);
    e.gates[0].verdict = Verdict::pass;
  }
  return e;
}

/// Cases a, b, ... with one row each; `stone` was asked for.
std::string answer(const std::vector<EngineRow>& rows, const std::string& shard = "") {
  Results r;
  r.asked = {"stone"};
  r.shard = shard;
  for (const auto& e : rows) {
    r.cases.emplace_back();
    r.cases.back().id = std::string(1, static_cast<char>('a' + r.cases.size() - 1));
    EngineRow other = e;
    other.name = "other";
    r.cases.back().engines = {other, e};
  }
  const auto list = unanswered(r);
  return list.empty() ? "" : list.size() == 1 ? list[0] : "several";
}

TEST(JudgeAsked, EachEndOfAnEngineHasItsSentence) {
  const auto ok = stone(Status::ok, {Status::ok}, true), unjudged = stone(Status::ok, {Status::ok}),
             missing = stone(Status::missing), refused = stone(Status::refused, {Status::refused});
  const std::string asked = "stone was asked for",
                    no_gate =
                        ", and is not judged: no gate names it, and none is for every engine ([[gate]] "
                        "engine = \"stone\", or none)",
                    leave =
                        ", and nothing of it is judged: leave it out, or ask for a case that it takes; "
                        "refused in a: its reason";
  EXPECT_EQ(answer({ok}), "");
  EXPECT_EQ(answer({}), asked + " and is not there");
  EXPECT_EQ(answer({missing, missing}), asked + " and is not there; missing in a: its reason");
  EXPECT_EQ(answer({missing, ok}), "");
  for (const auto& [status, word] :
       {std::pair{Status::killed, "killed"}, std::pair{Status::timeout, "timeout"},
        std::pair{Status::error, "error"}})
    EXPECT_EQ(answer({ok, stone(status, {status})}), asked + " and is " + word + " in b: its reason") << word;
  EXPECT_EQ(answer({ok, stone(Status::diverged, {Status::diverged})}), "");
  EXPECT_EQ(answer({stone(Status::killed, {Status::killed}), stone(Status::error, {Status::error})}),
            asked + " and is killed in a: its reason");
  EXPECT_EQ(answer({ok, stone(Status::refused, {Status::ok, Status::refused})}),
            asked + ", and ran a part of b (its reason) and refused the rest");
  EXPECT_EQ(answer({ok, stone(Status::refused, {Status::refused, Status::refused})}), "");
  EXPECT_EQ(answer({refused}), asked + " and ran no case; it refuses the one case" + leave);
  EXPECT_EQ(answer({refused, refused}), asked + " and ran no case; it refuses all 2 cases" + leave);
  EXPECT_EQ(answer({missing, refused}), asked + " and ran no case; missing in a: its reason");
  EXPECT_EQ(answer({unjudged}), asked + ", ran 1 case" + no_gate);
  EXPECT_EQ(answer({unjudged, unjudged}), asked + ", ran 2 cases" + no_gate);
  EXPECT_EQ(answer({stone(Status::diverged, {Status::diverged})}), asked + ", ran 1 case" + no_gate);
  EXPECT_EQ(answer({unjudged, ok}), "");
  auto gate_without_value = unjudged;
  gate_without_value.gates.resize(1);
  gate_without_value.gates[0].verdict = Verdict::missing;
  EXPECT_EQ(answer({gate_without_value}), asked + ", ran 1 case" + no_gate);
}

TEST(JudgeAsked, APartOfASuiteOwesNoAnswerOfTheRest) {
  const auto unjudged = stone(Status::ok, {Status::ok}), refused = stone(Status::refused, {Status::refused});
  EXPECT_EQ(answer({}, "2/4"), "");
  EXPECT_NE(answer({}, "1/1"), "");
  EXPECT_NE(answer({stone(Status::missing)}, "2/4"), "");
  EXPECT_EQ(answer({unjudged}, "2/4"), "");
  EXPECT_EQ(answer({refused}, "2/4"), "");
  EXPECT_NE(answer({unjudged}, "1/1"), "");
  EXPECT_NE(answer({stone(Status::error, {Status::error})}, "2/4"), "");
}

TEST(JudgeAsked, TheStatusesThatAreNoProperEnd) {
  for (const auto& [status, is_crash] :
       {std::pair{Status::ok, false}, std::pair{Status::refused, false}, std::pair{Status::missing, false},
        std::pair{Status::diverged, false}, std::pair{Status::killed, true}, std::pair{Status::timeout, true},
        std::pair{Status::error, true}}) {
    RunRow run;
    run.status = status;
    EXPECT_EQ(crashed(run), is_crash) << to_string(status);
    auto row = stone(status);
    EXPECT_EQ(is_unjudged(row), status == Status::ok) << to_string(status);
    row.name = "exact";
    EXPECT_FALSE(is_unjudged(row));
    EXPECT_FALSE(is_unjudged(stone(status, {}, true)));
  }
}

// --- one gate on one engine

struct Tried {
  Applied applied;
  std::vector<GateRow> rows;
};

/// The limit of 0.1 on `error`, applied to an engine of one run that is changed first.
Tried tried(const std::function<void(EngineRow&, RunRow&, Gate&)>& change) {
  CaseResult c;
  EngineRow e;
  e.name = "stone";
  e.runs = {run_with({{"error", value(0.05)}})};
  auto gate = limit("error", 0.1);
  change(e, e.runs[0], gate);
  const auto applied = apply_gate(c, gate, e);
  return {applied, e.gates};
}

TEST(JudgeGate, ARunThatGaveNothingIsARowUnlessItsEngineMayStayAway) {
  const auto of = [](Status status, bool required, bool comparable = true) {
    return tried([&](EngineRow& e, RunRow& r, Gate&) {
      e.required = required;
      r.status = status;
      r.comparable = comparable;
    });
  };
  for (const auto status : {Status::refused, Status::missing}) {
    EXPECT_EQ(of(status, false).applied, Applied::absent) << to_string(status);
    EXPECT_TRUE(of(status, false).rows.empty()) << to_string(status);
  }
  for (const auto& [status, required, comparable, verdict] :
       {std::tuple{Status::refused, true, true, Verdict::missing},
        std::tuple{Status::refused, false, false, Verdict::missing},
        std::tuple{Status::ok, false, false, Verdict::missing},
        std::tuple{Status::killed, false, true, Verdict::missing},
        std::tuple{Status::timeout, false, true, Verdict::missing},
        std::tuple{Status::error, false, true, Verdict::missing},
        std::tuple{Status::diverged, false, true, Verdict::diverged},
        std::tuple{Status::ok, false, true, Verdict::pass}}) {
    const auto t = of(status, required, comparable);
    EXPECT_EQ(t.applied, Applied::judged) << to_string(status);
    ASSERT_EQ(t.rows.size(), 1u) << to_string(status);
    EXPECT_EQ(t.rows[0].verdict, verdict) << to_string(status);
    EXPECT_EQ(t.rows[0].why, verdict == Verdict::pass ? "" : std::string(to_string(status)))
        << to_string(status);
  }
  const auto told = tried([](EngineRow&, RunRow& r, Gate&) {
    r.status = Status::killed;
    r.reason = "signal 9";
  });
  EXPECT_EQ(told.rows.at(0).why, "signal 9");
}

TEST(JudgeGate, SaysWhatWasMeasuredAndWhatIsAllowed) {
  const auto why = [](double v, double u, const std::string& note = "") {
    return tried([&](EngineRow&, RunRow& r, Gate&) {
             r.metrics["error"] = value(v, u);
             r.metrics["error"].note = note;
           })
        .rows.at(0)
        .why;
  };
  EXPECT_EQ(why(0.05, 0.0), "");
  EXPECT_EQ(why(0.2, 0.01), "0.2 with standard uncertainty 0.01, limit 0.1");
  EXPECT_EQ(why(0.1, 0.01), "0.1 with standard uncertainty 0.01, limit 0.1");
  EXPECT_EQ(why(std::nan(""), 0.0), "not finite");
  EXPECT_EQ(why(infinity, 0.0, "it flew off"), "not finite: it flew off");
  const auto other = tried([](EngineRow&, RunRow&, Gate& g) { g.metric = "another"; });
  EXPECT_EQ(other.rows.at(0).why, "the run has no metric of this name");
  EXPECT_EQ(other.rows.at(0).verdict, Verdict::missing);
}

TEST(JudgeGate, LooksAtTheRunsOfItsModeAndLevel) {
  const auto at = [](double run, std::optional<double> gate) {
    return tried([&](EngineRow&, RunRow& r, Gate& g) {
      r.levels = {{{Axis::spacing}, run}};
      g.level = gate;
    });
  };
  EXPECT_EQ(at(0.1, {}).rows.at(0).level, 0.1);
  EXPECT_EQ(at(0.1, 0.1).rows.at(0).level, 0.1);
  EXPECT_EQ(at(0.1, 0.2).applied, Applied::not_applicable);
  EXPECT_FALSE(tried([](EngineRow&, RunRow&, Gate&) {}).rows.at(0).level.has_value());
  const auto two = tried([](EngineRow&, RunRow& r, Gate&) {
    r.levels = {{{Axis::spacing}, 0.1}, {{Axis::time_step}, 0.2}};
  });
  EXPECT_FALSE(two.rows.at(0).level.has_value());
  EXPECT_EQ(tried([](EngineRow&, RunRow&, Gate& g) { g.mode = JudgedMode::paper; }).applied,
            Applied::not_applicable);
  EXPECT_EQ(tried([](EngineRow&, RunRow& r, Gate& g) { g.mode = r.knobs.mode = JudgedMode::paper; })
                .rows.at(0)
                .mode,
            JudgedMode::paper);
  EXPECT_EQ(tried([](EngineRow& e, RunRow&, Gate&) { e.runs.clear(); }).applied, Applied::absent);
  EXPECT_EQ(tried([](EngineRow&, RunRow& r, Gate&) { r.input = "k=1"; }).applied, Applied::not_applicable);
}

TEST(JudgeGate, PoolsTheSeedsOfAGroupAndNoOthers) {
  const auto rows = [](const std::string& a, const std::string& b) {
    return tried([&](EngineRow& e, RunRow& r, Gate&) {
             r.group = a;
             auto second = r;
             second.group = b;
             second.metrics["error"].value = 0.09;
             e.runs.push_back(second);
           })
        .rows;
  };
  ASSERT_EQ(rows("base", "base").size(), 1u);
  EXPECT_NEAR(rows("base", "base")[0].value, 0.07, 1e-15);
  EXPECT_EQ(rows("base", "other").size(), 2u);
  EXPECT_EQ(rows("", "").size(), 2u);
}

Tried tried_order(const OrderRow& order, const std::function<void(CaseResult&, EngineRow&, Gate&)>& change) {
  CaseResult c;
  EngineRow e;
  e.name = "stone";
  e.runs = {run_with({})};
  e.order = {order};
  Gate gate;
  gate.metric = "error.order";
  gate.at_least = 1.5;
  change(c, e, gate);
  const auto applied = apply_gate(c, gate, e);
  return {applied, e.gates};
}

OrderRow order_of(double value, double low, double high, FitClass name = FitClass::asymptotic) {
  OrderRow o;
  o.metric = "error";
  o.order.value = value;
  o.order.low = low;
  o.order.high = high;
  o.order.fit_class = name;
  return o;
}

TEST(JudgeOrder, HoldsWithItsIntervalOrIsExact) {
  const auto none = [](CaseResult&, EngineRow&, Gate&) {};
  const auto good = tried_order(order_of(2.0, 1.75, 2.25), none);
  EXPECT_EQ(good.rows.at(0).verdict, Verdict::pass);
  EXPECT_EQ(good.rows.at(0).low, 1.75);
  EXPECT_EQ(good.rows.at(0).high, 2.25);
  EXPECT_EQ(good.rows.at(0).why, "");
  EXPECT_EQ(tried_order(order_of(1.25, 1.0, 1.375), none).rows.at(0).why,
            "order 1.25, 95 % interval 1 to 1.38, asymptotic, at least 1.5");
  const auto exact = order_of(0.0, 0.0, 0.0, FitClass::roundoff);
  EXPECT_EQ(tried_order(exact, none).rows.at(0).verdict, Verdict::pass);
  for (const auto& change : std::vector<std::function<void(CaseResult&, EngineRow&, Gate&)>>{
           [](CaseResult&, EngineRow&, Gate& g) { g.engine = "stone"; },
           [](CaseResult&, EngineRow&, Gate& g) { g.limit = 3.0; },
           [](CaseResult&, EngineRow&, Gate& g) {
             g.band = {1.5, 2.5};
           }})
    EXPECT_EQ(tried_order(exact, change).rows.at(0).verdict, Verdict::fail);
}

TEST(JudgeOrder, ThatCouldNotBeFittedIsMissingWhereAStudyOwesIt) {
  const auto without = [](const std::function<void(CaseResult&, EngineRow&, Gate&)>& change) {
    return tried_order(order_of(2.0, 1.75, 2.25), [&](CaseResult& c, EngineRow& e, Gate& g) {
      e.order.clear();
      c.studies.resize(1);
      c.studies[0].levels = {0.1, 0.05};
      change(c, e, g);
    });
  };
  const auto due = without([](CaseResult&, EngineRow&, Gate&) {});
  EXPECT_EQ(due.rows.at(0).why, "nothing could be fitted: a level is missing or not finite");
  EXPECT_EQ(due.rows.at(0).verdict, Verdict::missing);
  EXPECT_EQ(without([](CaseResult& c, EngineRow&, Gate&) { c.studies.clear(); }).applied,
            Applied::not_applicable);
  EXPECT_EQ(without([](CaseResult&, EngineRow& e, Gate&) { e.name = "exact"; }).applied,
            Applied::not_applicable);
  EXPECT_EQ(without([](CaseResult& c, EngineRow&, Gate&) { c.studies[0].engine = "other"; }).applied,
            Applied::not_applicable);
  EXPECT_EQ(without([](CaseResult& c, EngineRow&, Gate&) { c.studies[0].engine = "stone"; }).applied,
            Applied::judged);
  EXPECT_EQ(without([](CaseResult&, EngineRow&, Gate& g) { g.level = 0.05; }).applied, Applied::judged);
  EXPECT_EQ(without([](CaseResult&, EngineRow&, Gate& g) { g.level = 0.2; }).applied,
            Applied::not_applicable);
  EXPECT_EQ(without([](CaseResult&, EngineRow& e, Gate&) { e.runs[0].status = Status::refused; }).applied,
            Applied::absent);
  EXPECT_EQ(without([](CaseResult&, EngineRow& e, Gate&) { e.runs[0].comparable = false; }).applied,
            Applied::absent);
  EXPECT_EQ(without([](CaseResult&, EngineRow& e, Gate&) {
              e.runs[0].status = Status::refused;
              e.required = true;
            }).applied,
            Applied::judged);
  EXPECT_EQ(without([](CaseResult&, EngineRow& e, Gate&) { e.runs[0].status = Status::killed; }).applied,
            Applied::judged);
}

// --- a case and a suite

TEST(JudgeCase, SaysWhatIsWrongWithItAndOfWhich) {
  struct Row {
    std::string says;
    std::function<void(Results&)> change;
  };
  for (const auto& row : std::vector<Row>{
           {"tripoint: the results hold no run of it", [](Results& r) { engine(r).runs.clear(); }},
           {"tripoint is required and is error: the results hold no run of it",
            [](Results& r) { engine(r).runs.clear(); }},
           {"tripoint is required and is refused: refused",
            [](Results& r) { engine(r).runs[0].status = Status::refused; }},
           {"tripoint is not comparable: another mass",
            [](Results& r) {
              engine(r).runs[0].comparable = false;
              engine(r).runs[0].reason = "another mass";
            }},
           {"tripoint diverged: at 1 s",
            [](Results& r) {
              engine(r).runs[0].status = Status::diverged;
              engine(r).runs[0].reason = "at 1 s";
            }},
           {"one.toml:7:3: the gate on error gives no reason for its limit",
            [](Results& r) {
              r.cases[0].gates[0].reason.clear();
              r.cases[0].gates[0].place = {"one.toml", 7, 3};
            }},
           {"one.toml:7:3: the gate on error judges nothing: no engine, mode or level of the case fits it",
            [](Results& r) {
              r.cases[0].gates[0].mode = JudgedMode::paper;
              r.cases[0].gates[0].place = {"one.toml", 7, 3};
            }},
           {"no gate judges this case", [](Results& r) { r.cases[0].gates.clear(); }},
           {"tripoint is required, and no gate of the case judges it",
            [](Results& r) { r.cases[0].gates.clear(); }},
           {"declares a defect, which only a gate with band or at_least can measure, and has none",
            [](Results& r) { r.cases[0].expect = Expect::defect; }},
           {"is declared to diverge, and no run did",
            [](Results& r) {
              r.cases[0].expect = Expect::diverges;
              r.cases[0].engines.clear();
            }},
           {"tripoint is declared to diverge, and no run of it did",
            [](Results& r) { r.cases[0].expect = Expect::diverges; }},
           {"no engine ran this case", [](Results& r) { r.cases[0].engines.clear(); }}}) {
    auto r = green();
    row.change(r);
    judge(r);
    const auto& list = r.cases[0].problems;
    EXPECT_EQ(std::count(list.begin(), list.end(), row.says), 1)
        << row.says << " / " << (list.empty() ? "" : list[0]);
    EXPECT_NE(r.exit_code, exit_pass) << row.says;
  }
}

TEST(JudgeSuite, HoldsEachPlannedCaseOnce) {
  const auto problems = [](const std::function<void(Results&)>& change, int code) {
    auto r = green();
    change(r);
    judge(r);
    EXPECT_EQ(r.exit_code, code);
    return r.problems.empty() ? std::string() : r.problems[0];
  };
  EXPECT_EQ(problems([](Results&) {}, exit_pass), "");
  EXPECT_EQ(problems(
                [](Results& r) {
                  r.cases.clear();
                  r.planned.clear();
                },
                exit_missing),
            "the results hold no case");
  EXPECT_EQ(problems([](Results& r) { r.cases.push_back(r.cases[0]); }, exit_missing),
            "test/one: two cases have this id");
  EXPECT_EQ(problems([](Results& r) { r.planned.push_back("test/two"); }, exit_missing),
            "test/two: was planned and is not in the results");
  EXPECT_EQ(problems(
                [](Results& r) {
                  r.planned.push_back("test/two");
                  r.interrupted = true;
                },
                exit_interrupted),
            "stopped by Ctrl-C: 1 of 2 planned cases are complete");
  EXPECT_EQ(problems(
                [](Results& r) {
                  r.cases.clear();
                  r.interrupted = true;
                },
                exit_interrupted),
            "stopped by Ctrl-C: 0 of 1 planned cases are complete");
}

// --- headroom --------------------------------------------------------------------

TEST(HeadroomEdges, WarnsAboveThreeAndFailsAboveTen) {
  const auto remark = [](
                          double most,
                          const std::function<void(Results&)>& change = [](Results&) {}) -> std::string {
    auto r = green();
    error(r).value = 0.125;
    r.cases[0].gates[0].limit = most;
    r.cases[0].gates[0].place = {"one.toml", 7, 3};
    change(r);
    judge(r);
    const auto list = headroom_remarks(r);
    if (list.empty()) return "";
    EXPECT_EQ(list[0].place.line, 7);
    EXPECT_EQ(list[0].excess, most / 0.125);
    EXPECT_EQ(list[0].title, "test/one: the limit of error is loose");
    EXPECT_EQ(list[0].code, list[0].error ? exit_fail : exit_pass);
    return list[0].error ? "error" : "warning";
  };
  EXPECT_EQ(remark(0.375), "");
  EXPECT_EQ(remark(0.376), "warning");
  EXPECT_EQ(remark(1.25), "warning");
  EXPECT_EQ(remark(1.26), "error");
  EXPECT_EQ(remark(1.26, [](Results& r) { r.cases[0].gates[0].date = "2026-01-01"; }), "warning");
  EXPECT_EQ(remark(1.26, [](Results& r) { r.only_engines = {"tripoint"}; }), "warning");
  EXPECT_EQ(remark(1.26,
                   [](Results& r) {
                     r.only_engines = {"tripoint"};
                     r.cases[0].gates[0].engine = "tripoint";
                   }),
            "error");
  const auto absent = [](Results& r) { r.cases[0].engines.push_back(stone(Status::missing)); };
  EXPECT_EQ(remark(1.26, absent), "warning");
  EXPECT_EQ(remark(1.26,
                   [&](Results& r) {
                     absent(r);
                     r.cases[0].gates[0].engine = "tripoint";
                   }),
            "error");
  EXPECT_EQ(remark(1.26,
                   [&](Results& r) {
                     absent(r);
                     r.cases[0].engines[1].name = "exact";
                   }),
            "error");
}

}  // namespace
}  // namespace tripoint
