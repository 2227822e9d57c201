// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "validation/case/case.hpp"
#include "validation/mutation/selftest_runs.hpp"
#include "validation/mutation/smallest.hpp"

namespace tripoint {
namespace {

/// First of the metrics whose gate is red; empty = none.
std::string red_metric(const CaseResult& result, const std::vector<std::string>& metrics,
                       const std::string& defect) {
  const auto at = std::find_if(metrics.begin(), metrics.end(), [&](const std::string& m) {
    return look(result, m, decisive_mode(result, m, defect)).red;
  });
  return at == metrics.end() ? std::string() : *at;
}

SmallestOutcome bisect(const Case& value, const Defect& defect, const EngineEntry& engine,
                       const SelftestOptions& o) {
  SmallestOutcome outcome;
  outcome.defect = defect.name;
  outcome.case_id = value.id;
  outcome.stored = *defect.smallest;
  outcome.place = defect.place;
  for (const auto& d : engine.defects)
    if (d.name == defect.name) outcome.what = d.what;
  const auto is_red = [&](double size) {
    const auto metric = red_metric(
        run_with_defect(value, engine, defect.killed_by, fmt::format("{}={:.17g}", defect.name, size),
                        "smallest-" + defect.name, o),
        defect.killed_by, defect.name);
    if (!metric.empty()) outcome.metric = metric;
    return !metric.empty();
  };
  // Takes either sign. A value close to one edge of its limit would otherwise make defects towards that edge
  // look visible however small.
  const auto found = smallest_visible(*defect.smallest, defect.size,
                                      [&](double size) { return is_red(size) && is_red(-size); });
  outcome.runs = found.runs;
  outcome.hidden = found.hidden;
  if (found.size) outcome.size = *found.size;
  if (!found.size)
    outcome.verdict = Size::unseen;
  else if (!found.found)
    outcome.verdict = Size::never_green;
  else
    outcome.verdict = against_stored(*found.size, outcome.stored);
  return outcome;
}

}  // namespace

std::vector<SmallestOutcome> try_smallest(const Case& value, const EngineEntry& engine,
                                          const SelftestOptions& o) {
  std::vector<SmallestOutcome> rows;
  for (const auto& defect : value.defects)
    if (defect.smallest) rows.push_back(bisect(value, defect, engine, o));
  return rows;
}

}  // namespace tripoint
