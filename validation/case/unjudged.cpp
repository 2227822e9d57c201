// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/preflight.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/case/case.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/known_defect.hpp"

namespace tripoint {
namespace {

std::vector<Finding> nothing_judges(const Case& value) {
  const bool expects =
      std::ranges::any_of(value.studies, [](const Study& s) { return s.expect.has_value(); });
  if (!value.gates.empty() || expects || value.expect == Expect::diverges) return {};
  const std::string gate = value.metrics.empty()
                               ? "a [[metric]], and a [[gate]] on it with a limit and its reason"
                               : fmt::format("a [[gate]] with metric = \"{}\", a limit and its reason",
                                             value.metrics.front().name);
  return {{false,
           fmt::format("no gate judges this case: it can be run, but `tripoint validate` ends 4. Add {}; "
                       "`tripoint new NAME` writes "
                       "a case that shows how",
                       gate),
           {value.file, 0, 0}}};
}

void open_metrics(const Case& value, std::vector<Finding>& found) {
  for (const auto& name : unjudged_metrics(value.metrics, value.gates, value.studies)) {
    const auto at = std::ranges::find(value.metrics, name, &MetricChoice::name);
    found.push_back({false,
                     fmt::format("no gate judges the metric \"{}\": a fault that it alone sees stays green. "
                                 "Give it a gate with a "
                                 "limit and its reason, or remove it",
                                 name),
                     at->place});
  }
}

/// A floor alone passes any greater error: 0.05 m and 3 m look the same.
void open_defects(const Case& value, std::vector<Finding>& found) {
  for (const Gate& g : value.gates)
    if (!declared_defect(g).empty() && g.at_least && !g.limit && !g.band)
      found.push_back({false,
                       fmt::format("the known defect {} of {} is bounded from below alone, and any greater "
                                   "error passes: write a band "
                                   "about the measured value",
                                   declared_defect(g), g.engine.empty() ? "every engine" : g.engine),
                       g.place});
}

bool judges_limit(const Case& value, const Study& s, const std::string& metric) {
  return std::ranges::any_of(value.gates,
                             [&](const Gate& g) { return g.metric == metric + std::string(limit_part); }) ||
         (s.expect && *s.expect == FitClass::plateau);
}

/// A ladder in time or space that every engine climbs shows where its error ends: at the truth, or at a wrong
/// constant.
void open_ladders(const Case& value, std::vector<Finding>& found) {
  for (const Study& s : value.studies) {
    if (!s.engine.empty() || s.levels.size() < 3 ||
        (s.axes.axis != Axis::time_step && s.axes.axis != Axis::spacing))
      continue;
    for (const MetricChoice& m : value.metrics) {
      const bool accepted = std::ranges::any_of(
          value.gates, [&](const Gate& g) { return g.engine.empty() && g.metric == m.name; });
      if (!accepted || (!s.metric.empty() && s.metric != m.name) || judges_limit(value, s, m.name)) continue;
      found.push_back({false,
                       fmt::format("every engine runs the study over {}, and no gate judges where the error "
                                   "of \"{}\" ends: a wrong "
                                   "constant hides below the acceptance limit. Add a gate on \"{}.limit\"",
                                   to_string(s.axes.axis), m.name, m.name),
                       s.place});
    }
  }
}

}  // namespace

std::vector<std::string> unjudged_metrics(const std::vector<MetricChoice>& metrics,
                                          const std::vector<Gate>& gates, const std::vector<Study>& studies) {
  std::vector<std::string> names;
  for (const MetricChoice& m : metrics) {
    const bool gated = std::ranges::any_of(
        gates, [&](const Gate& g) { return judges_metric(fitted_metric(g.metric), m.name); });
    const bool expected = std::ranges::any_of(studies, [&](const Study& s) {
      return s.expect && (s.metric.empty() ? m.name == metrics.front().name : s.metric == m.name);
    });
    if (!gated && !expected) names.push_back(m.name);
  }
  return names;
}

std::vector<Finding> unjudged(const Case& value) {
  auto found = nothing_judges(value);
  if (found.empty() && value.expect != Expect::diverges) open_metrics(value, found);
  open_defects(value, found);
  open_ladders(value, found);
  return found;
}

}  // namespace tripoint
