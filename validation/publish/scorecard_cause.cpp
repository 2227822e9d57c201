// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/scorecard_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/publish/scorecard.hpp"

namespace tripoint {
namespace {

constexpr double widest = 4.0;  // upper over lower end of a band: a wider one is like too many errors

/// "no-gyroscopic-term" -> "without gyroscopic term", "soft-contact" -> "with soft contact".
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '-', ' ');
  return name.starts_with("no ") ? "without " + name.substr(3) : "with " + name;
}

bool at_same_level(const Gate& a, const Gate& b) { return !a.level || !b.level || *a.level == *b.level; }

double width(const Gate& g) {
  const double low = std::min(std::abs((*g.band)[0]), std::abs((*g.band)[1]));
  const double high = std::max(std::abs((*g.band)[0]), std::abs((*g.band)[1]));
  return (*g.band)[0] * (*g.band)[1] > 0.0 ? high / low : INFINITY;
}

bool is_like(const Gate& known, const GateRow& row, const EngineRow& engine) {
  return !known_defect(known).empty() && known.engine != engine.name && known.metric == row.metric &&
         known.band && width(known) <= widest && at_same_level(known, row.gate) &&
         verdict_of(known, row.value, 0.0) == Verdict::pass;
}

/// The known defect with the narrowest band that holds the error, and every engine that has it.
std::string as_others(const CaseResult& c, const GateRow& row, const EngineRow& engine) {
  const Gate* nearest = nullptr;
  for (const auto& g : c.gates)
    if (is_like(g, row, engine) && (!nearest || width(g) < width(*nearest))) nearest = &g;
  if (!nearest) return {};
  std::vector<std::string> whose;
  for (const auto& g : c.gates)
    if (is_like(g, row, engine) && known_defect(g) == known_defect(*nearest))
      whose.push_back(label_of(g.engine, g.preset.empty() ? default_preset : g.preset));
  return fmt::format("as of an engine {} ({})", spoken(known_defect(*nearest)), fmt::join(whose, ", "));
}

/// The limit of our own solver on this metric, which its smallest seen defect reaches.
double own_limit(const CaseResult& c, const GateRow& row) {
  for (const auto& g : c.gates)
    if (is_own_solver(g.engine) && g.mode != JudgedMode::paper && g.metric == row.metric && g.limit &&
        at_same_level(g, row.gate))
      return *g.limit;
  return not_a_number;
}

/// The size of a registered defect that makes such an error, in proportion to the smallest size that our
/// limit sees.
std::string as_registered(const CaseResult& c, const Case* value, const GateRow& row) {
  if (!value) return {};
  for (const auto& d : value->defects) {
    if (!d.smallest || std::ranges::find(d.killed_by, row.metric) == d.killed_by.end()) continue;
    const double size = *d.smallest * std::abs(row.value) / own_limit(c, row);
    if (std::isfinite(size) && size < 1.0)
      return fmt::format("as of {} off by about {:.1g} of itself", d.name, size);
  }
  return {};
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + "; or " + b;
}

}  // namespace

std::string likely_cause(const CaseResult& c, const Case* value, const EngineRow& engine) {
  std::vector<std::string> found;
  for (const auto& row : engine.gates) {
    if (!is_acceptance(row.gate) || row.verdict != Verdict::fail || is_of_ladder(row.metric)) continue;
    const auto like = joined(as_others(c, row, engine), as_registered(c, value, row));
    if (!like.empty()) found.push_back(fmt::format("{} {:.3g}: {}", row.metric, row.value, like));
  }
  return fmt::format("{}", fmt::join(found, ". "));
}

}  // namespace tripoint
