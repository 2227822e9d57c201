// SPDX-License-Identifier: BSD-3-Clause
#include "validation/judge/headroom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "validation/case/dates.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

bool is_count(const CaseResult& c, const std::string& metric) {
  static constexpr std::array<std::string_view, 7> counts{
      "body_count", "bonded_objects", "object_count", "phase_count", "event_count", "toggles", "processes"};
  const auto at = std::find_if(c.metrics.begin(), c.metrics.end(),
                               [&](const MetricChoice& m) { return m.name == metric; });
  return at != c.metrics.end() && at->scale == 1.0 &&
         std::find(counts.begin(), counts.end(), at->quantity) != counts.end();
}

/// The value farthest from zero that the gate lets pass; infinite where it has no ceiling.
double ceiling(const Gate& g) {
  double most = g.limit.value_or(infinity);
  if (g.band) most = std::min(most, std::max(std::abs((*g.band)[0]), std::abs((*g.band)[1])));
  return most;
}

bool states_a_figure(const Gate& g) { return g.band && ((*g.band)[0] > 0.0 || (*g.band)[1] < 0.0); }

/// How many times wider a band around a figure is than what was measured: at its middle it uses none of its
/// room.
double headroom_of_figure(const Gate& g, double value, double u) {
  const double low = std::abs((*g.band)[0]), high = std::abs((*g.band)[1]), least = std::min(low, high);
  const double size = std::abs(value);
  return std::max(std::max(low, high) / (size + 2.0 * u), least > 0.0 ? (size + 2.0 * u) / least : 0.0);
}

/// The gate, wherever it is applied.
std::string key_of(const CaseResult& c, const Gate& g) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", c.id, g.place.line, g.metric, g.engine, g.mode, g.preset,
                     g.level.value_or(0.0));
}

/// A limit that every engine must hold may be used by one that is not here: how loose it is then is not
/// known.
bool some_engine_is_absent(const CaseResult& c, const Gate& g) {
  return g.engine.empty() && std::any_of(c.engines.begin(), c.engines.end(), [](const auto& e) {
           return !is_exact(e.name) && e.status != Status::ok;
         });
}

/// A date in the future silences nothing.
bool is_dated(const Gate& g) { return is_date(g.date) && !is_in_the_future(g.date); }

Remark remark_on(const CaseResult& c, const GateRow& row, double headroom, bool engines_were_chosen) {
  Remark r;
  r.error = headroom > headroom_fails && !is_dated(row.gate) && !some_engine_is_absent(c, row.gate) &&
            !(engines_were_chosen && row.gate.engine.empty());
  r.code = r.error ? exit_fail : exit_pass;
  r.place = row.gate.place;
  r.excess = headroom;
  r.title = fmt::format("{}: the limit of {} is loose", c.id, row.metric);
  r.text = fmt::format(
      "{} is asked, {:.3g} with standard uncertainty {:.2g} was measured: headroom by a factor of {:.3g}{}",
      describe(row.gate), row.value, row.uncertainty, headroom,
      r.error               ? "; tighten it, or give the reason a date"
      : !is_dated(row.gate) ? ""
                            : " (dated " + row.gate.date + ")");
  return r;
}

}  // namespace

std::optional<double> headroom_of(const CaseResult& c, const GateRow& row) {
  const Gate& g = row.gate;
  if (row.verdict != Verdict::pass || row.expect || is_of_ladder(row.metric) || !std::isfinite(row.value))
    return {};
  if (ceiling(g) <= roundoff_limit || (!g.limit && !g.band && g.at_least.value_or(0.0) <= 0.0)) return {};
  if (states_a_figure(g)) return headroom_of_figure(g, row.value, row.uncertainty);
  double size = std::abs(row.value) + 2.0 * row.uncertainty;
  if (is_count(c, row.metric)) size = std::max(size, 0.5);
  const double used = share_of_limit(g, std::copysign(size, row.value));
  return used > 0.0 ? 1.0 / used : infinity;
}

namespace {

bool is_tight(const CaseResult& c, const GateRow& row) {
  if (row.verdict != Verdict::pass || row.expect) return false;
  return ceiling(row.gate) <= roundoff_limit || headroom_of(c, row).value_or(infinity) <= headroom_warns;
}

/// A wide limit, such as one that holds for any engine, lets nothing pass where another gate holds the same
/// value.
bool is_held_by_another(const CaseResult& c, const EngineRow& e, const GateRow& row) {
  return std::any_of(e.gates.begin(), e.gates.end(), [&](const GateRow& other) {
    return &other != &row && other.metric == row.metric && other.mode == row.mode &&
           other.level == row.level && is_tight(c, other);
  });
}

}  // namespace

std::vector<Remark> headroom_remarks(const Results& results) {
  std::vector<Remark> list;
  for (const auto& c : results.cases) {
    std::map<std::string, std::pair<double, const GateRow*>> tightest;
    for (const auto& e : c.engines)
      for (const auto& row : e.gates) {
        const auto headroom = headroom_of(c, row);
        // a row whose limit is not too wide settles the gate
        const double s = is_held_by_another(c, e, row) ? 0.0 : headroom.value_or(0.0);
        const auto [at, is_new] = tightest.try_emplace(key_of(c, row.gate), s, &row);
        if (!is_new && s < at->second.first) at->second = {s, &row};
      }
    for (const auto& [key, found] : tightest)
      if (found.first > headroom_warns)
        list.push_back(remark_on(c, *found.second, found.first, !results.only_engines.empty()));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.excess > b.excess; });
  return list;
}

}  // namespace tripoint
