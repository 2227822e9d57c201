// SPDX-License-Identifier: BSD-3-Clause
#include "validation/judge/judge.hpp"
#include "validation/results/rows.hpp"

#include "validation/results/interrupt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "validation/case/engine_names.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/physics.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

/// Collects the faults of a case: a sentence and its exit code.
struct Findings {
  std::vector<std::string>& problems;
  std::set<int> codes;
  void add(int code, const std::string& what) {
    codes.insert(code);
    if (std::find(problems.begin(), problems.end(), what) == problems.end()) problems.push_back(what);
  }
};

/// The row says what its worst run says; a row that claims to be ok and has no run is a hole in the results.
void settle_status(const CaseResult& result, EngineRow& engine, Findings& findings) {
  if (engine.runs.empty() && engine.status == Status::ok) {
    engine.status = Status::error;
    engine.reason = "the results hold no run of it";
    findings.add(exit_missing, label_of(engine.name, engine.preset) + ": " + engine.reason);
  }
  for (const auto& run : engine.runs) {
    if (run.status == Status::diverged && !may_diverge(result, run.knobs.mode))
      findings.add(exit_diverged, fmt::format("{}{} diverged: {}", label_of(engine.name, engine.preset),
                                              after_blank(run.knobs.mode), run.reason));
    if (!run.comparable)
      findings.add(exit_missing, label_of(engine.name, engine.preset) + " is not comparable: " + run.reason);
  }
  const auto bad = std::find_if(engine.runs.begin(), engine.runs.end(),
                                [](const auto& r) { return r.status != Status::ok || !r.comparable; });
  if (!engine.runs.empty()) {
    engine.status = bad == engine.runs.end()    ? Status::ok
                    : bad->status == Status::ok ? Status::error
                                                : bad->status;
    engine.reason = bad == engine.runs.end() ? ""
                    : bad->reason.empty()    ? std::string(to_string(bad->status))
                                             : bad->reason;
  }
  if (const auto broken = broken_refusal(engine); !broken.empty())
    findings.add(exit_fail, label_of(engine.name, engine.preset) + " " + broken);
  if (engine.required && engine.status != Status::ok && engine.status != Status::diverged)
    findings.add(exit_missing,
                 fmt::format("{} is required and is {}: {}", label_of(engine.name, engine.preset),
                             engine.status, engine.reason));
}

bool same_preset(const Gate& gate, const EngineRow& engine) {
  return gate.preset.empty() || gate.preset == engine.preset;
}

bool names(const Gate& gate, const EngineRow& engine) {
  if (!same_preset(gate, engine)) return false;
  return gate.engine.empty() ? !is_exact(engine.name) : gate.engine == engine.name;
}

/// The gate by which the case declares that an engine does not hold an acceptance limit; nullptr where it
/// declares none.
const Gate* declared_failure(const CaseResult& result, const Gate& acceptance, const EngineRow& engine) {
  if (!acceptance.engine.empty()) return nullptr;
  const auto at = std::find_if(result.gates.begin(), result.gates.end(), [&](const Gate& g) {
    return !known_defect(g).empty() && g.metric == acceptance.metric && g.engine == engine.name &&
           same_preset(g, engine);
  });
  return at == result.gates.end() ? nullptr : &*at;
}

/// An engine that is excused must fail: a declaration that is no longer true turns red, so that it is taken
/// away.
Applied apply_excused(const CaseResult& result, const Gate& gate, const Gate& declared, EngineRow& engine) {
  auto tried = engine;
  tried.gates.clear();
  const auto applied = apply_gate(result, gate, tried);
  const bool holds =
      !tried.gates.empty() && std::all_of(tried.gates.begin(), tried.gates.end(),
                                          [](const GateRow& row) { return row.verdict == Verdict::pass; });
  for (auto& row : tried.gates) {
    if (!holds) continue;
    row.verdict = Verdict::fail;
    row.excused = true;
    row.why = fmt::format("holds the limit, though {} declares the defect {}: take the declaration away",
                          to_string(declared.place), known_defect(declared));
    engine.gates.push_back(row);
  }
  return applied;
}

void apply_to_all(CaseResult& result, const Gate& gate, bool engines_were_chosen, Findings& findings) {
  if (gate.reason.empty())
    findings.add(exit_missing, fmt::format("{}: the gate on {} gives no reason for its limit",
                                           to_string(gate.place), gate.metric));
  int named = 0, judged = 0, absent = 0;
  for (auto& engine : result.engines) {
    if (!names(gate, engine)) continue;
    ++named;
    const auto* declared = declared_failure(result, gate, engine);
    const auto applied =
        declared ? apply_excused(result, gate, *declared, engine) : apply_gate(result, gate, engine);
    judged += applied == Applied::judged;
    absent += applied == Applied::absent;
  }
  const bool left_out = engines_were_chosen && !gate.engine.empty() &&
                        std::none_of(result.engines.begin(), result.engines.end(),
                                     [&](const auto& e) { return e.name == gate.engine; });
  if (judged > 0 || absent > 0 || (named == 0 && left_out)) return;
  findings.add(exit_missing,
               fmt::format("{}: the gate on {} judges nothing: no engine, mode or level of the case fits it",
                           to_string(gate.place), gate.metric));
}

/// Every engine that was chosen refuses the case, and none is required: it is no case of theirs. An engine
/// that ran no case at all is reported by the whole (unanswered).
bool is_refused(const CaseResult& result, bool engines_were_chosen) {
  // The truth is no engine that could take the case
  const auto is_judge = [](const EngineRow& e) { return is_exact(e.name); };
  if (!engines_were_chosen || std::all_of(result.engines.begin(), result.engines.end(), is_judge))
    return false;
  return std::all_of(result.engines.begin(), result.engines.end(), [&](const EngineRow& e) {
    return is_judge(e) || (e.status == Status::refused && !e.required);
  });
}

void count_gates(CaseResult& result, Findings& findings) {
  int judged = 0, two_sided = 0;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.gates) {
      ++judged;
      two_sided += row.gate.band || row.gate.at_least;
      if (row.verdict == Verdict::fail)
        findings.codes.insert(exit_fail);
      else if (row.verdict == Verdict::inconclusive)
        findings.codes.insert(exit_inconclusive);
      else if (row.verdict == Verdict::diverged)
        findings.codes.insert(may_diverge(result, row.mode) ? exit_pass : exit_diverged);
      else if (row.verdict != Verdict::pass)
        findings.codes.insert(exit_missing);
    }
  if (judged == 0 && result.expect != Expect::diverges)
    findings.add(exit_missing, "no gate judges this case");
  if (result.expect == Expect::defect && two_sided == 0)
    findings.add(exit_missing,
                 "declares a defect, which only a gate with band or at_least can measure, and has none");
}

/// Each engine that the case requires must diverge, and where it requires none each that ran: another's word
/// does not stand for it.
void check_divergence(const CaseResult& result, Findings& findings) {
  if (!may_diverge(result, JudgedMode::paper)) return;
  const bool some_required =
      std::any_of(result.engines.begin(), result.engines.end(), [](const auto& e) { return e.required; });
  int asked = 0;
  for (const auto& engine : result.engines) {
    const auto due = [&](const RunRow& run) {
      return may_diverge(result, run.knobs.mode) &&
             (run.status == Status::ok || run.status == Status::diverged);
    };
    if ((some_required ? !engine.required : is_exact(engine.name)) ||
        std::none_of(engine.runs.begin(), engine.runs.end(), due))
      continue;
    ++asked;
    if (std::none_of(engine.runs.begin(), engine.runs.end(),
                     [&](const RunRow& run) { return due(run) && run.status == Status::diverged; }))
      findings.add(exit_fail,
                   label_of(engine.name, engine.preset) + " is declared to diverge, and no run of it did");
  }
  if (asked == 0) findings.add(exit_fail, "is declared to diverge, and no run did");
}

void check_planned(const Results& results, std::vector<std::string>& problems, std::set<int>& codes) {
  const auto say = [&](const std::string& what) {
    problems.push_back(what);
    codes.insert(exit_missing);
  };
  if (results.cases.empty() && !results.interrupted) say("the results hold no case");
  std::set<std::string> seen;
  for (const auto& c : results.cases)
    if (!seen.insert(c.id).second) say(c.id + ": two cases have this id");
  if (results.interrupted) {
    problems.push_back(fmt::format("stopped by {}: {} of {} planned cases are complete",
                                   name_of_stop(stopped_by()), seen.size(), results.planned.size()));
    codes.insert(exit_interrupted);
    return;
  }
  for (const auto& id : results.planned)
    if (!seen.count(id)) say(id + ": was planned and is not in the results");
}

}  // namespace

void judge(CaseResult& result, bool engines_were_chosen) {
  result.problems.clear();
  Findings findings{result.problems, {}};
  if (result.engines.empty()) findings.add(exit_missing, "no engine ran this case");
  for (auto& engine : result.engines) {
    settle_status(result, engine, findings);
    engine.order.clear();
    engine.gates.clear();
    for (const auto& study : result.studies)
      for (auto& row : fit_orders(result, engine, study)) engine.order.push_back(std::move(row));
  }
  for (const auto& gate : result.gates) apply_to_all(result, gate, engines_were_chosen, findings);
  for (const auto& study : result.studies)
    if (study.expect)
      for (auto& engine : result.engines) apply_expected_class(result, study, engine);
  for (const auto& engine : result.engines)
    if (engine.required && is_unjudged(engine) && result.expect != Expect::diverges)
      findings.add(exit_missing,
                   label_of(engine.name, engine.preset) + " is required, and no gate of the case judges it");
  for (const auto& name : result.adopted)
    if (std::none_of(result.engines.begin(), result.engines.end(),
                     [&](const auto& e) { return e.name == name; }))
      findings.add(
          exit_missing,
          fmt::format("{} was adopted by this case, and was left out by --engines: name it there", name));
  settle_physics(result);
  const bool refused = is_refused(result, engines_were_chosen);
  if (!refused) count_gates(result, findings);
  check_divergence(result, findings);
  result.exit_code = first_of(findings.codes);
  result.verdict =
      refused && result.exit_code == exit_pass ? CaseVerdict::refused : verdict_of(result.exit_code);
}

void judge(Results& results) {
  std::set<int> codes;
  results.problems.clear();
  for (auto& c : results.cases) {
    judge(c, !results.only_engines.empty());
    codes.insert(c.exit_code);
  }
  check_planned(results, results.problems, codes);
  // The only fault is that the chosen engines take no case: none passes unjudged, and nothing is missing
  // either.
  const bool all_refused = codes == std::set<int>{exit_pass} &&
                           std::all_of(results.cases.begin(), results.cases.end(),
                                       [](const auto& c) { return c.verdict == CaseVerdict::refused; });
  for (const auto& what : unanswered(results)) {
    results.problems.push_back(what);
    codes.insert(exit_missing);
  }
  results.exit_code = first_of(codes);
  results.verdict = all_refused ? CaseVerdict::refused : verdict_of(results.exit_code);
}

}  // namespace tripoint
