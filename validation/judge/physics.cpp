// SPDX-License-Identifier: BSD-3-Clause
#include "validation/judge/physics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "validation/case/engine_names.hpp"
#include "validation/case/known_defect.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

/// The defect that a gate declares of an engine, or that it predicts of the printed form; empty = none.
std::string declared(const CaseResult& result, const Gate& gate) {
  if (auto name = declared_defect(gate); !name.empty()) return name;
  return result.expect == Expect::defect && (gate.band || gate.at_least) ? "declared-by-the-case" : "";
}

/// The value meets the acceptance limit from which the engine is excused: the declaration is out of date, not
/// the value.
bool meets_acceptance(const EngineRow& engine, const GateRow& row) {
  return std::any_of(engine.gates.begin(), engine.gates.end(), [&](const GateRow& other) {
    return other.excused && other.metric == row.metric && other.mode == row.mode && other.level == row.level;
  });
}

Physics physics_of(const CaseResult& result, const EngineRow& engine, const GateRow& row) {
  if (row.excused) return Physics::right;
  switch (row.verdict) {
    case Verdict::pass:
      return row.defect.empty() ? Physics::right : Physics::known_defect;
    case Verdict::fail:
      return !row.defect.empty() && meets_acceptance(engine, row) ? Physics::right : Physics::wrong;
    case Verdict::diverged:
      return may_diverge(result, row.mode) ? Physics::known_defect : Physics::wrong;
    default:
      return Physics::unknown;
  }
}

Physics worst_of(Physics a, Physics b) {
  for (const auto p : {Physics::wrong, Physics::known_defect, Physics::unknown})
    if (a == p || b == p) return p;
  return Physics::right;
}

void add_name(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void settle_row(const CaseResult& result, const EngineRow& engine, GateRow& row) {
  // A ladder that ends on a floor has no order: how much of the limit its number uses has no meaning.
  const bool no_order = row.fit_class && *row.fit_class == FitClass::plateau;
  row.used = row.expect || no_order ? not_a_number : share_of_limit(row.gate, row.value);
  row.defect = row.excused ? std::string() : declared(result, row.gate);
  if (row.verdict == Verdict::diverged && may_diverge(result, row.mode)) row.defect = "divergence";
  row.physics = physics_of(result, engine, row);
}

void settle_engine(const CaseResult& result, EngineRow& engine) {
  for (auto& row : engine.gates) settle_row(result, engine, row);
  engine.physics = engine.gates.empty() ? Physics::unknown : Physics::right;
  engine.defects.clear();
  for (const auto& row : engine.gates) {
    engine.physics = worst_of(engine.physics, row.physics);
    if (row.physics == Physics::known_defect) add_name(engine.defects, row.defect);
  }
  for (const auto& run : engine.runs) {
    if (run.status != Status::diverged) continue;
    const bool declares = may_diverge(result, run.knobs.mode);
    engine.physics = engine.physics == Physics::unknown && declares
                         ? Physics::known_defect
                         : worst_of(engine.physics, declares ? Physics::known_defect : Physics::wrong);
    if (declares) add_name(engine.defects, "divergence");
  }
}

}  // namespace

void settle_physics(CaseResult& result) {
  bool any = false;
  result.physics = Physics::right;
  for (auto& engine : result.engines) {
    settle_engine(result, engine);
    if (engine.gates.empty() && engine.physics == Physics::unknown) continue;  // it was judged by nobody
    result.physics = worst_of(result.physics, engine.physics);
    any = true;
  }
  if (!any) result.physics = Physics::unknown;
}

std::string physics_text(Physics physics, const std::vector<std::string>& defects) {
  return physics == Physics::known_defect ? fmt::format("{} {}", physics, fmt::join(defects, ", "))
                                          : std::string(to_string(physics));
}

std::string physics_text(const CaseResult& result) {
  if (result.physics == Physics::right || result.physics == Physics::unknown)
    return std::string(to_string(result.physics));
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  for (const auto& e : result.engines) {
    if (e.physics != Physics::wrong && e.physics != Physics::known_defect) continue;
    const auto words = physics_text(e.physics, e.defects), name = label_of(e.name, e.preset);
    const auto at = std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first == words; });
    if (at == said.end())
      said.push_back({words, {name}});
    else
      at->second.push_back(name);
  }
  std::string text;
  for (const auto& [words, names] : said)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", words, fmt::join(names, ", "));
  return text;
}

std::string physics_counts(const Results& results) {
  const auto count = [&](Physics p) {
    return std::count_if(results.cases.begin(), results.cases.end(),
                         [&](const auto& c) { return c.physics == p; });
  };
  std::string text = fmt::format("physics: {} right", count(Physics::right));
  if (const auto n = count(Physics::known_defect); n > 0) text += fmt::format(", {} with known defects", n);
  if (const auto n = count(Physics::unknown); n > 0) text += fmt::format(", {} not known", n);
  return text + fmt::format(", {} wrong", count(Physics::wrong));
}

std::string physics_text(const GateRow& row) { return physics_text(row.physics, {row.defect}); }

}  // namespace tripoint
