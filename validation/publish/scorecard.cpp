// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/scorecard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/publish/releases.hpp"
#include "validation/publish/scorecard_cause.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

constexpr double same_error = 1e-6;   // share by which two errors may differ and still share a place
constexpr double disagreement = 0.5;  // of the acceptance limit

bool is_fitted(const Gate& g) { return is_of_ladder(g.metric); }

const MetricChoice* metric_of(const CaseResult& c, const std::string& name) {
  const auto at =
      std::find_if(c.metrics.begin(), c.metrics.end(), [&](const auto& m) { return m.name == name; });
  return at == c.metrics.end() ? nullptr : &*at;
}

bool is_momentum(const MetricChoice& m) {
  return m.quantity == "momentum" || m.quantity == "angular_momentum";
}

/// A law of conservation. The drift of an angle or of a height is none, as these may change in a right run.
bool is_conserved(const MetricChoice& m) {
  static constexpr std::array<std::string_view, 6> kept{
      "mass", "ledger.residual", "ledger.time_integration", "ledger.kinetic", "ledger.thermal", "energy"};
  if (is_momentum(m) || m.quantity == "energy_gain") return true;
  return m.norm == Norm::drift && std::ranges::find(kept, m.quantity) != kept.end();
}

/// How much an error in this metric says of the motion, 0 the most. A wrong motion may keep its energy
/// exactly, and a missing torque still changes angular momentum.
int weakness(const CaseResult& c, const Gate& g) {
  const auto* m = metric_of(c, g.metric);
  if (!m || !is_conserved(*m)) return 0;
  return is_momentum(*m) ? 1 : 2;
}

/// The run at the case's own resolution; of our solver the corrected one.
const RunRow* own_run(const EngineRow& e) {
  const auto at = std::find_if(e.runs.begin(), e.runs.end(),
                               [](const auto& r) { return r.base && r.knobs.mode != JudgedMode::paper; });
  return at == e.runs.end() ? nullptr : &*at;
}

double error_of(const EngineRow& e, const Gate* gate) {
  const auto* run = own_run(e);
  if (!gate || !run || run->status != Status::ok || !run->comparable) return not_a_number;
  const auto value = measured(*run, gate->metric);
  return value ? value->value : not_a_number;
}

/// The edge of the acceptance limit that is farthest from zero.
double edge(const Gate& g) {
  return g.limit  ? *g.limit
         : g.band ? std::max(std::abs((*g.band)[0]), std::abs((*g.band)[1]))
                  : not_a_number;
}

bool same_place(double a, double b) {
  return std::abs(a - b) <= same_error * std::max(a, b) || std::max(a, b) <= roundoff_limit;
}

std::string why(const GateRow& g) {
  return g.metric + ": " + (g.why.empty() ? std::string(to_string(g.verdict)) : g.why);
}

Score score_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return Score::pass;
    case Verdict::fail:
      return Score::fail;
    case Verdict::inconclusive:
      return Score::inconclusive;
    case Verdict::missing:
      return Score::not_judged;
    case Verdict::diverged:
      break;
  }
  return Score::diverged;
}

void settle(const EngineRow& e, ScoreRow& row) {
  const auto set = [&](Score verdict, const std::string& reason) {
    row.verdict = verdict;
    row.reason = reason;
  };
  if (const auto broken = broken_refusal(e); !broken.empty()) return set(Score::fail, broken);
  if (refuses_as_expected(e)) return set(Score::refused, "as expected: " + e.reason);
  if (e.status == Status::missing) return set(Score::missing, e.reason);
  if (e.status == Status::refused) return set(Score::refused, e.reason);
  if (e.status == Status::killed || e.status == Status::timeout || e.status == Status::error)
    return set(Score::crashed, fmt::format("{}: {}", e.status, e.reason));
  const GateRow* known = nullptr;
  bool judged = false;
  for (const auto bad : {Verdict::diverged, Verdict::fail, Verdict::missing, Verdict::inconclusive})
    for (const auto& g : e.gates)
      if (g.mode != JudgedMode::paper && g.verdict == bad) return set(score_of(bad), why(g));
  for (const auto& g : e.gates) {
    if (g.mode == JudgedMode::paper) continue;
    judged = judged || is_acceptance(g.gate);
    if (!known_defect(g.gate).empty() && !known) known = &g;
  }
  if (known) row.defect = known_defect(known->gate);
  if (known)
    return set(Score::known_defect,
               fmt::format("{} ({}: {:.3g})", known_defect(known->gate), known->metric, known->value));
  if (e.status == Status::diverged) return set(Score::diverged, e.reason);
  if (!judged) return set(Score::not_judged, "no acceptance limit fits its runs");
  set(Score::pass, "");
}

ScoreRow settled(const EngineRow& e) {
  ScoreRow row;
  settle(e, row);
  return row;
}

/// An engine that holds every limit of the case has a place among those that do; any other has none.
void place(const CaseResult& c, const Gate* gate, const EngineRow& engine, ScoreRow& row) {
  const double own = std::abs(row.error);
  if (!std::isfinite(own) || row.verdict != Score::pass) return;
  row.rank = 1;
  for (const auto& e : c.engines) {
    const double other = std::abs(error_of(e, gate));
    if (is_exact(e.name) || !std::isfinite(other) || settled(e).verdict != Score::pass) continue;
    ++row.of;
    if (&e != &engine && other < own && !same_place(other, own)) ++row.rank;
  }
}

void conservation(const CaseResult& c, const RunRow& run, ScoreRow& row) {
  for (const auto& m : c.metrics) {
    const auto at = run.metrics.find(m.name);
    if (!is_conserved(m) || at == run.metrics.end() || !std::isfinite(at->second.value)) continue;
    if (std::isfinite(row.drift) && std::abs(at->second.value) <= std::abs(row.drift)) continue;
    row.drift = at->second.value;
    row.drift_metric = m.name;
  }
}

WorstLimit worst_of(const CaseResult& c, const EngineRow& e) {
  WorstLimit worst;
  for (const auto& g : c.gates) {
    if (!is_acceptance(g) || is_fitted(g)) continue;
    const double value = error_of(e, &g), share = share_of_limit(g, value);
    if (!std::isfinite(share) || share <= worst.share) continue;
    const auto* metric = metric_of(c, g.metric);
    worst = {g.metric, metric ? metric->unit : "", describe(g), value, share};
  }
  return worst;
}

/// The order of the metric that ranks, else of the first study that gave one.
void observed(const EngineRow& e, ScoreRow& row) {
  const OrderRow* chosen = nullptr;
  for (const auto& o : e.order) {
    if (o.mode == JudgedMode::paper) continue;
    if (!chosen || (o.metric == row.metric && chosen->metric != row.metric)) chosen = &o;
  }
  if (chosen) {
    row.order = chosen->order.value;
    row.order_metric = chosen->metric;
    row.order_class = chosen->order.fit_class;
  }
}

ScoreRow row_of(const CaseResult& c, const Case* value, const EngineRow& e) {
  ScoreRow row;
  row.case_id = c.id;
  row.title = c.title;
  settle(e, row);
  row.cause = likely_cause(c, value, e);
  const auto* gate = ranking_gate(c);
  if (gate) {
    const auto* metric = metric_of(c, gate->metric);
    row.metric = gate->metric;
    row.unit = metric ? metric->unit : "";
    row.allowed = describe(*gate);
    row.error = error_of(e, gate);
    row.share = share_of_limit(*gate, row.error);
    place(c, gate, e, row);
  }
  observed(e, row);
  row.worst = worst_of(c, e);
  if (const auto* run = own_run(e); run && run->status == Status::ok) {
    conservation(c, *run, row);
    row.cpu_s = run->cost.cpu_s;
    for (const auto& ours : c.engines)
      if (const auto* base = own_run(ours);
          is_own_solver(ours.name) && base && base->status == Status::ok && base->cost.cpu_s > 0.0)
        row.cost = row.cpu_s / base->cost.cpu_s;
  }
  return row;
}

std::string words_on(const EngineRow& e, const Case* value, const std::vector<EngineEntry>& engines) {
  const auto* entry = find_engine(engines, e.name);
  if (!entry) return {};
  std::string text;
  if (const auto at = entry->settings.find("preset " + e.preset); at != entry->settings.end())
    text = at->second;
  if (!value) return text;
  for (const auto& choice : value->engines)
    for (const auto& [key, setting] : choice.settings)
      if (const auto at = entry->settings.find(key); choice.name == e.name && at != entry->settings.end())
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", key, at->second);
  return text;
}

/// How far two engines are apart in a metric: by their own trajectories where these are compared, else by
/// their values.
double apart(const CaseResult& c, const Gate& gate, const EngineRow& a, const EngineRow& b) {
  const auto la = label_of(a.name, a.preset), lb = label_of(b.name, b.preset);
  for (const auto& q : c.equivalence)
    if (q.metric == gate.metric && ((q.a == la && q.b == lb) || (q.a == lb && q.b == la)))
      return std::abs(q.difference);
  return std::abs(error_of(a, &gate) - error_of(b, &gate));
}

std::optional<Disagreement> disagreement_of(const CaseResult& c, const Case* value,
                                            const std::vector<EngineEntry>& engines) {
  const auto* gate = ranking_gate(c);
  if (!gate || !(edge(*gate) > 0.0)) return {};
  std::vector<const EngineRow*> ran;
  for (const auto& e : c.engines)
    if (!is_exact(e.name) && std::isfinite(error_of(e, gate))) ran.push_back(&e);
  const auto* metric = metric_of(c, gate->metric);
  Disagreement d{c.id, gate->metric, metric ? metric->unit : "", describe(*gate), {}, {}, 0.0, {}};
  for (std::size_t i = 0; i < ran.size(); ++i)
    for (std::size_t j = i + 1; j < ran.size(); ++j)
      if (const double x = apart(c, *gate, *ran[i], *ran[j]); x > d.difference) {
        d.difference = x;
        d.a = label_of(ran[i]->name, ran[i]->preset);
        d.b = label_of(ran[j]->name, ran[j]->preset);
      }
  if (!(d.difference > disagreement * edge(*gate))) return {};
  std::stable_sort(ran.begin(), ran.end(), [&](const auto* a, const auto* b) {
    return std::abs(error_of(*a, gate)) < std::abs(error_of(*b, gate));
  });
  for (const auto* e : ran)
    d.witnesses.push_back({label_of(e->name, e->preset), settled(*e).verdict, error_of(*e, gate),
                           words_on(*e, value, engines)});
  return d;
}

EngineScore& score_of(Scorecard& card, const EngineRow& e) {
  for (auto& s : card.engines)
    if (s.engine == e.name && s.preset == e.preset) return s;
  card.engines.push_back({e.name, e.preset, e.version, {}});
  return card.engines.back();
}

/// An engine that is missing everywhere was not asked for and is not here: it has no score.
bool is_absent(const EngineScore& s, const std::vector<std::string>& asked) {
  return s.count(Score::missing) == static_cast<int>(s.rows.size()) &&
         std::find(asked.begin(), asked.end(), s.engine) == asked.end();
}

}  // namespace

bool is_acceptance(const Gate& g) {
  return g.engine.empty() && g.preset.empty() && g.mode != JudgedMode::paper &&
         g.mode != JudgedMode::corrected;
}

const Gate* ranking_gate(const CaseResult& c) {
  const Gate* best = nullptr;
  for (const auto& g : c.gates)
    if (is_acceptance(g) && !is_fitted(g) && (!best || weakness(c, g) < weakness(c, *best))) best = &g;
  return best;
}

int EngineScore::count(Score verdict) const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [&](const auto& r) { return r.verdict == verdict; }));
}

Scorecard scorecard_of(const Results& results, const std::vector<Case>& cases,
                       const std::vector<EngineEntry>& engines) {
  Scorecard card;
  card.command = results.command;
  card.verdict = results.verdict;
  card.exit_code = results.exit_code;
  card.date = results.date;
  card.commit = results.tool.commit;
  for (const auto& c : results.cases) {
    const auto at =
        std::find_if(cases.begin(), cases.end(), [&](const auto& value) { return value.id == c.id; });
    const Case* value = at == cases.end() ? nullptr : &*at;
    for (const auto& e : c.engines)
      if (!is_exact(e.name)) score_of(card, e).rows.push_back(row_of(c, value, e));
    if (auto d = disagreement_of(c, value, engines)) card.disagreements.push_back(std::move(*d));
  }
  std::erase_if(card.engines, [&](const auto& s) { return is_absent(s, results.asked); });
  std::stable_sort(card.engines.begin(), card.engines.end(),
                   [](const auto& a, const auto& b) { return a.engine < b.engine; });
  return card;
}

}  // namespace tripoint
