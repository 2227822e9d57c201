// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/releases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "validation/case/case.hpp"

namespace tripoint {
namespace {

const EngineRow* row_of(const CaseResult& c, const std::string& preset) {
  const auto at =
      std::find_if(c.engines.begin(), c.engines.end(), [&](const auto& e) { return e.preset == preset; });
  return at == c.engines.end() ? nullptr : &*at;
}

/// Round-off that steps leave, in the unit of a metric of size one.
double round_off(const EngineEntry& engine) {
  return engine.build.find("single") == std::string::npos ? 1e-11 : 1e-5;
}

/// A metric against the exact solution of another scheme says what an engine is, not how far it is off.
bool is_of_a_scheme(const CaseResult& c, const std::string& metric) {
  return std::any_of(c.metrics.begin(), c.metrics.end(), [&](const auto& m) {
    return m.name == metric && m.reference && m.reference->kind == ReferenceKind::discrete_exact;
  });
}

bool lost_a_row(const CaseResult& from, const CaseResult& to) {
  return std::any_of(from.engines.begin(), from.engines.end(), [&](const auto& e) {
    const auto* after = row_of(to, e.preset);
    return e.status == Status::ok && (!after || after->status != Status::ok);
  });
}

}  // namespace

const RunRow* base_run(const EngineRow& e) {
  const auto at = std::find_if(e.runs.begin(), e.runs.end(), [](const auto& r) { return r.base; });
  return at == e.runs.end() ? nullptr : &*at;
}

const OrderRow* ladder_in_time(const EngineRow& e, const std::string& metric) {
  const auto at = std::find_if(e.order.begin(), e.order.end(), [&](const auto& o) {
    return o.metric == metric && o.axes == StudyAxes{Axis::time_step};
  });
  return at == e.order.end() ? nullptr : &*at;
}

double observed_order(const EngineRow& e, const std::string& metric) {
  const auto* ladder = ladder_in_time(e, metric);
  return ladder ? ladder->order.value : not_a_number;
}

std::vector<std::string> gates_turned_red(const Release& from, const Release& to) {
  std::vector<std::string> list;
  for (const auto& e : to.result.engines) {
    const auto* before = row_of(from.result, e.preset);
    for (const auto& g : e.gates) {
      if (g.verdict == Verdict::pass || !before) continue;
      const bool was_green = std::any_of(before->gates.begin(), before->gates.end(), [&](const auto& b) {
        return b.metric == g.metric && b.level == g.level && b.gate.place.line == g.gate.place.line &&
               b.gate.place.file == g.gate.place.file && b.verdict == Verdict::pass;
      });
      if (was_green) list.push_back(fmt::format("{} {}: {}", e.preset, g.metric, g.why));
    }
  }
  return list;
}

Case case_for_releases(Case value, const EngineEntry& engine, const std::vector<std::string>& presets,
                       const std::vector<double>& levels) {
  EngineChoice choice;
  choice.name = engine.name;
  for (const auto& e : value.engines)
    if (e.name == engine.name) choice = e;
  choice.required = false;
  if (!presets.empty()) choice.presets = presets;
  if (choice.presets.empty()) choice.presets = engine.presets;
  value.engines = {choice};
  std::vector<Study> studies;
  for (const auto& s : value.studies)
    if (levels.empty() && s.axes.axis == Axis::time_step && s.engine == engine.name) studies.push_back(s);
  if (studies.empty()) {
    Study study;
    study.axes.axis = Axis::time_step;
    study.engine = engine.name;
    study.levels = levels;
    const auto own = value.scene.time_step;
    if (levels.empty() && !own)
      throw InputError(value.id +
                       " leaves the time step to the engine: name --levels a,b,c, coarse to fine [s]");
    if (levels.empty()) study.levels = {2.0 * *own, *own, 0.5 * *own, 0.25 * *own};
    studies.push_back(study);
  }
  value.studies = studies;
  return value;
}

std::vector<ReleaseChange> changes_between(const Release& from, const Release& to, double margin) {
  std::vector<ReleaseChange> list;
  const double floor = std::max(round_off(from.engine), round_off(to.engine));
  for (const auto& e : to.result.engines) {
    const auto* before = row_of(from.result, e.preset);
    const auto *a = before ? base_run(*before) : nullptr, *b = base_run(e);
    if (!a || !b) continue;
    for (const auto& [name, value] : b->metrics) {
      const auto found = a->metrics.find(name);
      if (found == a->metrics.end() || is_of_a_scheme(to.result, name)) continue;
      const double x = std::max(std::abs(found->second.value), floor),
                   y = std::max(std::abs(value.value), floor);
      if (std::isfinite(x) == std::isfinite(y) && !(std::max(x, y) > margin * std::min(x, y))) continue;
      list.push_back({e.preset, name, from.engine.version, to.engine.version, found->second.value,
                      value.value, observed_order(*before, name), observed_order(e, name),
                      std::max(x, y) / std::min(x, y), std::min(x, y) <= floor, !(y < x)});
    }
  }
  return list;
}

bool is_worse(const ReleaseTable& t) {
  if (t.releases.size() < 2) return false;
  const auto &first = t.releases.front(), &last = t.releases.back();
  const auto changes = changes_between(first, last, t.margin);
  return std::any_of(changes.begin(), changes.end(), [](const auto& c) { return c.worse; }) ||
         !gates_turned_red(first, last).empty() || lost_a_row(first.result, last.result);
}

std::string upgrade_line(const ReleaseTable& t) {
  if (t.releases.size() < 2) return "one release: nothing to compare it with";
  const auto &first = t.releases.front(), &last = t.releases.back();
  std::string worse, better;
  for (const auto& c : changes_between(first, last, t.margin))
    (c.worse ? worse : better) +=
        fmt::format("{}{} {} {:.3g} -> {:.3g}", (c.worse ? worse : better).empty() ? "" : ", ", c.preset,
                    c.metric, c.before, c.after);
  for (const auto& red : gates_turned_red(first, last))
    worse += fmt::format("{}gate {}", worse.empty() ? "" : ", ", red);
  if (lost_a_row(first.result, last.result))
    worse += fmt::format("{}a preset that ran does not run", worse.empty() ? "" : ", ");
  const std::string head =
      fmt::format("{} {} in the place of {}: ", last.engine.name, last.engine.version, first.engine.version);
  if (worse.empty() && better.empty())
    return head + fmt::format("no error differs by more than {:g} times", t.margin);
  return head + (worse.empty() ? "nothing is worse; better: " + better
                               : "worse: " + worse + (better.empty() ? "" : "; better: " + better));
}

}  // namespace tripoint
