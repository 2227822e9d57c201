// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "scene/scene.hpp"
#include "validation/baseline/baseline_propose.hpp"
#include "validation/baseline/baseline_rows.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;

double allowance_of(const Gate& gate) {
  double allowance = gate.limit.value_or(std::numeric_limits<double>::infinity());
  if (gate.band) allowance = std::min(allowance, 0.5 * ((*gate.band)[1] - (*gate.band)[0]));
  if (!std::isfinite(allowance) && gate.at_least)
    allowance = *gate.at_least > 0.0 ? 1.0 / *gate.at_least : std::numeric_limits<double>::infinity();
  return allowance;
}

namespace {

std::string class_word(const AcceptedGate& g) {
  return g.fit_class ? std::string(to_string(*g.fit_class)) : std::string();
}

constexpr double change_seen = 0.1, cost_seen = 0.01;
constexpr const char* decide = ": tripoint gate accept --reason says who decided and why";

std::string title_of(const CaseResult& c, const AcceptedGate& g) {
  return fmt::format("{} {}{} {}", c.id, g.engine, after_blank(g.mode), g.metric);
}

/// Compares the limits and the metric of a gate with the accepted ones.
void compare_limits(const CaseResult& c, const AcceptedGate& now, const SourcePlace& place,
                    const AcceptedGate& old, bool less_is_better, std::vector<Remark>& list) {
  const auto title = title_of(c, now);
  if (const auto edge = looser_edge(now, old);
      !edge.empty() && !(less_is_better && is_nearer_truth(now, old)))
    list.push_back({true, exit_missing, place, title,
                    fmt::format("loosened: {} is looser than the accepted {} ({}){}", now.allows, old.allows,
                                edge, decide),
                    old.room > 0.0 ? now.room / old.room : infinity, "LOOSENED"});
  if (!old.measures.empty() && now.measures != old.measures)
    list.push_back({true, exit_missing, place, title,
                    fmt::format("its metric has changed since it was accepted (quantity, norm, body, place, "
                                "window, scale, unit or reference){}",
                                decide),
                    infinity, "CHANGED"});
  if (now.fit_class != old.fit_class)
    list.push_back({false,
                    0,
                    place,
                    title,
                    fmt::format("converges as {}, accepted was {}", class_word(now), class_word(old)),
                    1.0,
                    {}});
}

/// Share of its limit that a value uses.
double used_by(const AcceptedGate& g, double value) {
  Gate gate;
  gate.limit = g.limit;
  gate.at_least = g.at_least;
  gate.band = g.band;
  return share_of_limit(gate, value);
}

/// Two standard uncertainties of a difference, by what was accepted: the judged run has no word in its own
/// noise.
double accepted_noise(const AcceptedGate& old) {
  return 2.0 * std::sqrt(2.0) * old.uncertainty + roundoff_limit;
}

void compare_drift(const CaseResult& c, const AcceptedGate& now, const SourcePlace& place,
                   const AcceptedGate& old, std::vector<Remark>& list) {
  if (std::abs(now.value - old.value) <= *now.drift * std::abs(old.value) + accepted_noise(old)) return;
  list.push_back({true,
                  exit_fail,
                  place,
                  title_of(c, now),
                  fmt::format("{:.6g} has moved from the accepted value {:.6g} by more than the share of "
                              "{:g} that the gate allows",
                              now.value, old.value, *now.drift),
                  std::abs(now.value / old.value),
                  {}});
}

/// Worse is what uses more of the limit: by a tenth of what was used, or of half the width of a band that
/// states a figure.
bool is_worse(const AcceptedGate& now, double was, double noise) {
  const bool figure = now.band && ((*now.band)[0] > 0.0 || (*now.band)[1] < 0.0);
  const double before = used_by(now, was), grown = used_by(now, now.value) - before;
  return grown > change_seen * (figure ? 1.0 : before) && std::abs(now.value - was) > noise;
}

void compare_value(const CaseResult& c, const AcceptedGate& now, const SourcePlace& place,
                   const AcceptedGate& old, std::vector<Remark>& list) {
  if (is_of_ladder(now.metric) || now.fit_class) return;
  if (now.drift) return compare_drift(c, now, place, old, list);
  for (const auto& [word, was] : {std::pair{"accepted", old.value}, std::pair{"first", old.first_value}}) {
    if (!is_worse(now, was, accepted_noise(old))) continue;
    list.push_back(
        {false,
         0,
         place,
         title_of(c, now),
         fmt::format("{:.4g} is worse than the {} value {:.4g}: it uses {:.3g} of the limit, then {:.3g}",
                     now.value, word, was, used_by(now, now.value), used_by(now, was)),
         used_by(now, now.value),
         {}});
    return;
  }
}

void compare_cost(const CaseResult& c, const Tool& tool, const Baseline& b, std::vector<Remark>& list) {
  for (const auto& now : costs_of(c, tool)) {
    const auto old =
        std::find_if(b.cost.begin(), b.cost.end(), [&](const auto& o) { return o.run == now.run; });
    if (old == b.cost.end()) continue;
    // Another machine takes other vectors, and another count
    const double counted = now.counted_on == old->counted_on ? old->instructions : 0.0;
    for (const auto& [what, is, was] :
         {std::tuple{"pairs", now.pairs, old->pairs}, std::tuple{"steps", now.steps, old->steps},
          std::tuple{"instructions", now.instructions, counted}})
      if (is > 0.0 && was > 0.0 && is > (1.0 + cost_seen) * was)
        list.push_back({true,
                        exit_cost,
                        {c.file, 1, 0},
                        c.id + " " + now.run,
                        fmt::format("{:.4g} {}, accepted were {:.4g} ({:+.1f} %)", is, what, was,
                                    100.0 * (is / was - 1.0)),
                        is / was,
                        {}});
  }
}

/// Names runs that ended well when they were accepted, and do not any more; perhaps no gate judges them.
void compare_ends(const CaseResult& c, const Baseline& b, std::vector<Remark>& list) {
  for (const auto& e : c.engines)
    for (const auto& r : e.runs) {
      if (r.status == Status::ok || r.status == Status::missing) continue;
      if (std::ranges::find(b.cost, run_name(e, r), &AcceptedCost::run) == b.cost.end()) continue;
      list.push_back({true,
                      exit_missing,
                      {c.file, 1, 0},
                      c.id + " " + run_name(e, r),
                      fmt::format("the run is {}, and ran to its end when it was accepted{}",
                                  to_string(r.status), decide),
                      infinity,
                      "GONE"});
    }
}

/// Compares the scene, the reference and the required engines with the accepted ones.
void compare_question(const CaseResult& c, const Baseline& b, const std::optional<CaseHashes>& now,
                      std::vector<Remark>& list) {
  const auto say = [&](const std::string& what) {
    list.push_back({true, exit_missing, {c.file, 1, 0}, c.id, what + decide, infinity, "CHANGED"});
  };
  if (!b.id.empty() && b.id != c.id)
    say(fmt::format("its id was {} when its figures were accepted: it was renamed in place", one_line(b.id)));
  if (!b.sealed) say("its baseline was edited by hand, and `tripoint gate accept` is its only writer");
  if (!b.accepted.empty() && b.accepted.back().reason == undecided_reason)
    say("its baseline was proposed, and nobody has accepted it");
  if (b.scene.empty()) {  // accepted by an older version, which kept a hash of the text alone
    if (b.case_hash != hash_of_file(c))
      list.push_back({false,
                      0,
                      {c.file, 1, 0},
                      c.id,
                      "the case file has changed since its figures were accepted",
                      1.0,
                      {}});
    return;
  }
  if (!now)
    return say("the case file cannot be read again, and what was accepted cannot be compared with it");
  if (now->scene != b.scene)
    say("its scene, a study, or a setting of an engine has changed since its figures were accepted");
  if (now->reference != b.reference) say("its reference has changed since its figures were accepted");
  for (const auto& name : b.required) {
    const auto at = now->required.find(name);
    if (at == now->required.end() ? !is_own_solver(name) : !at->second)
      say(name + " was required when its figures were accepted, and is not any more");
  }
}

/// Whether less of a value is better: it is an error to a truth, or a limit on it was accepted too.
bool less_is_better(const CaseResult& c, const Baseline& b, const AcceptedGate& g) {
  if (std::any_of(b.gates.begin(), b.gates.end(), [&](const auto& other) {
        return other.metric == g.metric && other.engine == g.engine && other.preset == g.preset &&
               other.limit;
      }))
    return true;
  const auto m = std::find_if(c.metrics.begin(), c.metrics.end(),
                              [&](const auto& choice) { return choice.name == g.metric; });
  if (m == c.metrics.end() || m->norm == Norm::drift) return false;
  const auto kind = (m->reference ? *m->reference : c.reference).kind;
  return kind == ReferenceKind::analytic || kind == ReferenceKind::mms || kind == ReferenceKind::experiment;
}

void compare_case(const Results& results, const CaseResult& c, const Baseline& b, std::vector<Remark>& list) {
  const auto hashes = case_hashes(c.file);
  compare_question(c, b, hashes, list);
  compare_ends(c, b, list);
  const auto all = all_gates_of(c, hashes);
  std::size_t k = 0;
  for (const auto& e : c.engines)
    for (const auto& row : e.gates) {
      const auto* old = counterpart(all, k, b.gates);
      if (old && std::isfinite(row.value))
        compare_limits(c, all[k], row.gate.place, *old, less_is_better(c, b, *old), list);
      if (old && is_accepted(row)) compare_value(c, all[k], row.gate.place, *old, list);
      ++k;
    }
  const auto now = gates_of(c, hashes);
  if (c.exit_code == exit_pass)  // a red gate is no gate that is gone
    for (const auto* g : gone(c, now, b, !results.only_engines.empty()))
      list.push_back({true,
                      exit_missing,
                      {c.file, 1, 0},
                      title_of(c, *g),
                      fmt::format("was accepted with {} and judges nothing any more{}", g->allows, decide),
                      infinity,
                      "GONE"});
  if (b.seed == results.seed) compare_cost(c, results.tool, b, list);
}

/// One sentence for all: a suite that begins to keep baselines is not told a hundred times.
Remark none_yet(const std::vector<const CaseResult*>& cases) {
  constexpr std::size_t named = 5;
  std::string text = fmt::format(
      "{} cases have no baseline yet (tripoint gate accept --reason TEXT RESULTS.json ID): ", cases.size());
  for (std::size_t k = 0; k < std::min(named, cases.size()); ++k) text += (k > 0 ? ", " : "") + cases[k]->id;
  if (cases.size() > named) text += fmt::format(" and {} more", cases.size() - named);
  return {false, 0, {}, "baselines", text, 1.0, {}};
}

}  // namespace

std::vector<Remark> baseline_remarks(const Results& results, bool required, const std::string& root) {
  std::vector<Remark> list;
  std::vector<const CaseResult*> without;
  for (const auto& c : results.cases) {
    if (!required && root.empty() && !keeps_baselines(c.file)) continue;
    auto file = baseline_file(c.file, root);
    // New here: judged by what it brings
    if (!root.empty() && !fs::exists(file)) file = baseline_file(c.file);
    if (fs::exists(file))
      compare_case(results, c, read_baseline(file), list);
    else if (required)
      list.push_back({true,
                      exit_missing,
                      {c.file, 1, 0},
                      c.id,
                      "has no baseline: tripoint gate accept --reason TEXT RESULTS.json " + c.id,
                      infinity,
                      {}});
    else
      without.push_back(&c);
  }
  if (!without.empty()) list.push_back(none_yet(without));
  return list;
}

}  // namespace tripoint
