// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "validation/baseline/baseline.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

/// Properties that make two rows the same metric; `nth` tells gates apart that judge the same row.
using RowKey = std::tuple<std::string, std::string, JudgedMode, std::string, double, int>;

struct ComparedRow {
  RowKey key;
  MetricChange change;  ///< all but the two standings
  MetricStanding standing;
  Gate gate;
};

std::string unit_of(const CaseResult& c, const std::string& metric) {
  if (is_order(metric)) return "";
  const auto name = metric_of_gate(metric);
  const auto at =
      std::find_if(c.metrics.begin(), c.metrics.end(), [&](const auto& m) { return m.name == name; });
  return at == c.metrics.end() ? "" : at->unit;
}

ComparedRow new_row(const CaseResult& c, const EngineRow& e, JudgedMode mode, const std::string& metric) {
  ComparedRow row;
  row.change.case_id = c.id;
  row.change.engine = label_of(e.name, e.preset);
  row.change.mode = mode;
  row.change.metric = metric;
  row.change.unit = unit_of(c, metric);
  row.change.place = {c.file, 1, 0};
  return row;
}

/// Values of the runs that differ by seed only, of which the row's value is the mean.
std::vector<double> values_of_seeds(const EngineRow& e, const GateRow& g) {
  std::map<std::string, std::vector<double>> groups;
  std::vector<double> most;
  for (const auto& run : e.runs) {
    const bool at_level = g.level ? std::any_of(run.levels.begin(), run.levels.end(),
                                                [&](const auto& l) { return same_level(l.second, *g.level); })
                                  : run.levels.empty() || run.base;
    const auto v = measured(run, g.metric);
    if (run.knobs.mode != g.mode || !run.input.empty() || !at_level || run.group.empty() || !v) continue;
    auto& group = groups[run.group];
    group.push_back(v->value);
    if (group.size() > most.size()) most = group;
  }
  return most;
}

/// Standard error of the mean of several values, 0 of one.
double error_of_mean(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  if (values.size() < 2) return 0.0;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1.0) / n);
}

ComparedRow row_of(const CaseResult& c, const EngineRow& e, const GateRow& g) {
  auto row = new_row(c, e, g.mode, g.expect ? g.metric + " class" : g.metric);
  row.change.level = g.level;
  row.gate = g.gate;
  if (!g.gate.place.file.empty()) row.change.place = g.gate.place;
  auto& s = row.standing;
  s.value = g.value;
  s.verdict = g.verdict;
  s.fit_class = g.fit_class;
  const auto values = values_of_seeds(e, g);
  s.seeds = std::max(1, static_cast<int>(values.size()));
  s.allows = g.expect ? fmt::format("class {}", *g.expect) : describe(g.gate);
  s.used = g.used;
  // a 95 % interval is four standard deviations wide
  s.noise = g.low && g.high ? 0.25 * (*g.high - *g.low) : error_of_mean(values);
  s.stated = g.low && g.high ? 0.0 : g.budget.statistical;
  return row;
}

/// Metrics of the case's own run that no gate judges.
void add_unjudged(const CaseResult& c, const EngineRow& e, std::vector<ComparedRow>& rows) {
  for (const auto& run : e.runs) {
    if (!run.base || !run.input.empty() || run.status != Status::ok) continue;
    for (const auto& [name, value] : run.metrics) {
      const bool judged = std::any_of(e.gates.begin(), e.gates.end(), [&](const auto& g) {
        return g.metric == name && g.mode == run.knobs.mode;
      });
      if (judged) continue;
      auto row = new_row(c, e, run.knobs.mode, name);
      row.standing.value = value.value;
      row.standing.used = not_a_number;
      row.standing.stated = value.uncertainty.statistical;
      rows.push_back(row);
    }
  }
}

std::vector<ComparedRow> rows_of(const Results& r) {
  std::vector<ComparedRow> rows;
  for (const auto& c : r.cases)
    for (const auto& e : c.engines) {
      if (is_exact(e.name)) continue;  // its error is that of the reference to itself
      for (const auto& g : e.gates) rows.push_back(row_of(c, e, g));
      add_unjudged(c, e, rows);
    }
  std::map<RowKey, int> seen;
  for (auto& row : rows) {
    const auto& c = row.change;
    RowKey key{c.case_id, c.engine, c.mode, c.metric, c.level.value_or(-1.0), 0};
    std::get<5>(key) = seen[key]++;
    row.key = key;
  }
  return rows;
}

/// Two standard uncertainties of the difference between two runs that are each known so well.
double between_two(double uncertainty) { return 2.0 * std::sqrt(2.0) * uncertainty; }

/// An uncertainty that the base states counts up to so many times what the base differed from itself when it
/// ran again. By chance two runs are nearer to each other than that once in twelve.
constexpr double borne_out = 20.0;

bool is_roundoff(const Gate& g) { return g.limit && *g.limit <= roundoff_limit; }

/// Noise of head less base, in the metric's unit, and where it is from. It is measured: by seeds of the base,
/// or by what the base differed from itself when it ran again. No run has a word in it that nothing bears
/// out.
std::pair<double, std::string> noise_between(const MetricStanding& base, bool is_order, double again) {
  const double chance = between_two(base.noise),
               stated = std::min(between_two(base.stated), borne_out * again);
  if (std::max(again, stated) > chance) return {std::max(again, stated), "A/A"};
  if (!(chance > 0.0)) return {0.0, "none known"};
  return {chance, is_order ? "interval of the fit" : fmt::format("{} seeds", base.seeds)};
}

/// The most that this noise moves the share of the limit that a value uses.
double noise_of_share(const Gate& gate, double value, double noise) {
  const double here = share_of_limit(gate, value);
  return std::max(std::abs(share_of_limit(gate, value + noise) - here),
                  std::abs(share_of_limit(gate, value - noise) - here));
}

void settle_class(MetricChange& c) {
  if (c.base->fit_class == c.head->fit_class) return;
  c.change = c.head->verdict == Verdict::pass ? 0.0 : infinity;
  c.trend = c.head->verdict == Verdict::pass ? Trend::same : Trend::worse;
  c.noise_from = "a class has no size";
}

void settle_unlimited(MetricChange& c, double again) {
  const double size = std::abs(c.base->value), difference = std::abs(c.head->value - c.base->value);
  c.change = difference > 0.0 ? difference / (size > 0.0 ? size : 1.0) : 0.0;
  const auto [noise, from] = noise_between(*c.base, false, again);
  c.noise = noise / (size > 0.0 ? size : 1.0);
  c.noise_from = from;
}

/// A head whose seeds scatter by so much more than the base's has got worse, wherever its mean lies: the next
/// change could hide in it.
constexpr double scatters_more = 10.0;

void settle_scatter(MetricChange& c, const Gate& gate) {
  if (c.base->seeds < 2 || c.head->seeds < 2 || c.base->fit_class || is_roundoff(gate)) return;
  const double now = noise_of_share(gate, c.head->value, between_two(c.head->noise));
  if (!(now > std::max(scatters_more * c.noise, least_change))) return;
  c.trend = Trend::worse;
  c.noise_from += fmt::format(", now {:.2g}", now);
}

/// @param again how far the same code was seen to differ from itself (A/A), in the metric's unit; 0 = not
/// tried
void settle(MetricChange& c, const Gate& base_gate, const Gate& head_gate, double again) {
  if (!c.base || !c.head) return static_cast<void>(c.trend = c.head ? Trend::appeared : Trend::gone);
  c.limit_changed = c.base->allows != c.head->allows;
  c.looser = c.limit_changed &&
             (c.head->allows.empty() || allowance_of(head_gate) > allowance_of(base_gate) * (1.0 + 1e-9));
  if (c.base->fit_class && std::isnan(c.base->used) && std::isnan(c.head->used)) return settle_class(c);
  // a change that loosens a limit is measured by the limit that was there
  const Gate& gate = c.base->allows.empty() ? head_gate : base_gate;
  if (!gate.limit && !gate.band && !gate.at_least) return settle_unlimited(c, again);
  const double before = share_of_limit(gate, c.base->value), now = share_of_limit(gate, c.head->value);
  if (!std::isfinite(before) || !std::isfinite(now)) {
    c.change = std::isfinite(before) ? infinity : std::isfinite(now) ? -infinity : 0.0;
    c.noise_from = "no value";
  } else {
    c.change = now - before;
    const auto [noise, from] = noise_between(*c.base, c.base->fit_class.has_value(), again);
    c.noise = noise_of_share(gate, c.base->value, noise);
    c.noise_from = from;
    if (is_roundoff(gate) && c.noise < 1.0) {
      c.noise = 1.0;
      c.noise_from = "round-off";
    }
  }
  if (std::abs(c.change) > std::max(c.noise, least_change))
    c.trend = c.change > 0.0 ? Trend::worse : Trend::better;
  settle_scatter(c, gate);
}

/// Worse and better first, by their size; then unchanged ones; then new, then gone.
bool goes_before(const MetricChange& a, const MetricChange& b) {
  const auto rank = [](const MetricChange& c) {
    return c.trend == Trend::worse || c.trend == Trend::better ? 0
           : c.trend == Trend::same                            ? (std::isnan(c.base->used) ? 2 : 1)
           : c.trend == Trend::appeared                        ? 3
                                                               : 4;
  };
  return rank(a) != rank(b) ? rank(a) < rank(b) : std::abs(a.change) > std::abs(b.change);
}

std::vector<std::string> remarks_on(const Results& base, const Results& head) {
  std::vector<std::string> list;
  const auto differ = [&](const char* what, const std::string& b, const std::string& h) {
    if (b != h)
      list.push_back(
          fmt::format("{} of the base: {}; here: {}", what, b.empty() ? "none" : b, h.empty() ? "none" : h));
  };
  const auto profile = [](const Results& r) { return r.profile.empty() ? std::string("any") : r.profile; };
  differ("profile", profile(base), profile(head));
  differ("seed", fmt::format("{}", base.seed), fmt::format("{}", head.seed));
  differ("version of tripoint", base.tool.version, head.tool.version);
  if (base.interrupted) list.push_back("the base was interrupted and does not hold every case");
  if (base.exit_code != exit_pass) list.push_back(fmt::format("the base was itself {}", base.verdict));
  return list;
}

}  // namespace

int Comparison::count(Trend trend) const {
  return static_cast<int>(
      std::count_if(changes.begin(), changes.end(), [&](const auto& c) { return c.trend == trend; }));
}

Comparison compare_results(const Results& base, const Results& head, const std::string& base_name,
                           const Results* repeat) {
  Comparison all;
  all.base_name = base_name;
  all.remarks = remarks_on(base, head);
  std::map<RowKey, ComparedRow> before, again;
  for (auto& row : rows_of(base)) before.emplace(row.key, row);
  if (repeat)
    for (auto& row : rows_of(*repeat)) again.emplace(row.key, row);
  for (auto& row : rows_of(head)) {
    row.change.head = row.standing;
    const auto at = before.find(row.key);
    Gate base_gate;
    double differs = 0.0;
    if (at != before.end()) {
      row.change.base = at->second.standing;
      base_gate = at->second.gate;
      if (const auto twin = again.find(row.key); twin != again.end())
        differs = std::abs(twin->second.standing.value - at->second.standing.value);
      before.erase(at);
    }
    settle(row.change, base_gate, row.gate, std::isfinite(differs) ? differs : 0.0);
    all.changes.push_back(std::move(row.change));
  }
  for (auto& [key, row] : before) {
    row.change.base = row.standing;
    settle(row.change, row.gate, {}, 0.0);
    all.changes.push_back(std::move(row.change));
  }
  std::stable_sort(all.changes.begin(), all.changes.end(), goes_before);
  return all;
}

std::vector<Remark> change_remarks(const Comparison& all, bool no_worse) {
  std::vector<Remark> list;
  const auto say = [&](const MetricChange& c, int code, const std::string& text, const char* word) {
    list.push_back({no_worse, no_worse ? code : 0, c.place, c.case_id + " " + name_of(c), text,
                    std::isfinite(c.change) ? 1.0 + std::abs(c.change) : infinity, no_worse ? word : ""});
  };
  for (const auto& c : all.changes) {
    if (c.trend == Trend::worse && c.head->verdict == Verdict::pass)
      say(c, exit_fail,
          fmt::format("is worse than the base by {} of its limit, and within it: {}, {} of {}; noise {}",
                      change_text(c), values_text(c), used_text(c), c.base->allows, noise_text(c)),
          "WORSE");
    if (c.trend == Trend::gone)
      say(c, exit_missing, fmt::format("is in the base ({}) and not here", values_text(c)), "GONE");
    if (c.limit_changed && !c.base->allows.empty())
      list.push_back(
          {no_worse && c.looser, no_worse && c.looser ? exit_missing : 0, c.place,
           c.case_id + " " + name_of(c),
           fmt::format("its limit has changed: {} -> {}{}", c.base->allows,
                       c.head->allows.empty() ? "none" : c.head->allows, c.looser ? ", looser" : ""),
           1.0, no_worse && c.looser ? "LOOSENED" : ""});
  }
  return list;
}

}  // namespace tripoint
