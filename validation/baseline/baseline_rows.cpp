// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "files/job.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/escaped_text.hpp"

namespace tripoint {
namespace {

bool same_gate(const AcceptedGate& a, const AcceptedGate& b) {
  const bool same_place = a.level.has_value() == b.level.has_value() &&
                          (!a.level || std::abs(*a.level - *b.level) <= 1e-9 * std::abs(*b.level));
  return a.metric == b.metric && a.engine == b.engine && a.preset == b.preset && a.mode == b.mode &&
         same_place;
}

AcceptedGate gate_of(const EngineRow& e, const GateRow& row, const std::optional<CaseHashes>& hashes) {
  AcceptedGate g;
  g.metric = row.expect ? fmt::format("{} is {}", row.metric, *row.expect) : row.metric;
  g.engine = e.name;
  g.preset = preset_unless_default(e.preset);
  g.mode = row.mode;
  g.level = row.level;
  g.allows = row.expect ? fmt::format("class {}", *row.expect) : describe(row.gate);
  g.room = row.expect ? 1.0 : allowance_of(row.gate);
  g.value = row.value;
  g.uncertainty = row.uncertainty;
  g.fit_class = row.fit_class;
  g.limit = row.gate.limit;
  g.at_least = row.gate.at_least;
  g.band = row.gate.band;
  g.drift = row.gate.drift;
  if (!hashes) return g;
  if (const auto at = hashes->metrics.find(metric_of_gate(fitted_metric(row.metric)));
      at != hashes->metrics.end())
    g.measures = at->second;
  return g;
}

std::string counted_on(const Tool& tool, const RunRow& r) {
  return r.cost.instructions > 0.0
             ? fmt::format("{}; {}; {}; {}", r.cost.counted_by, tool.cpu, tool.compiler, tool.flags)
             : std::string();
}

}  // namespace

std::string hash_of_file(const CaseResult& c) {
  std::ifstream in(c.file, std::ios::binary);
  return text_hash({std::istreambuf_iterator<char>(in), {}});
}

bool is_accepted(const GateRow& row) { return std::isfinite(row.value) && row.verdict == Verdict::pass; }

std::vector<AcceptedGate> gates_of(const CaseResult& c, const std::optional<CaseHashes>& hashes) {
  std::vector<AcceptedGate> list;
  for (const auto& e : c.engines)
    for (const auto& row : e.gates)
      if (is_accepted(row)) list.push_back(gate_of(e, row, hashes));
  return list;
}

std::vector<AcceptedGate> all_gates_of(const CaseResult& c, const std::optional<CaseHashes>& hashes) {
  std::vector<AcceptedGate> list;
  for (const auto& e : c.engines)
    for (const auto& row : e.gates) list.push_back(gate_of(e, row, hashes));
  return list;
}

std::string run_name(const EngineRow& e, const RunRow& r) {
  const auto at = r.folder.find("/" + e.name + "/");
  return at == std::string::npos ? e.name + "/" + r.group : r.folder.substr(at + 1);
}

bool is_judged(const EngineRow& e) { return std::ranges::any_of(e.gates, is_accepted); }

std::vector<AcceptedCost> costs_of(const CaseResult& c, const Tool& tool) {
  std::vector<AcceptedCost> list;
  for (const auto& e : c.engines)
    for (const auto& r : e.runs)
      if (is_judged(e) && r.status == Status::ok && (r.cost.pairs > 0.0 || r.cost.steps > 0.0))
        list.push_back(
            {run_name(e, r), r.cost.pairs, r.cost.steps, r.cost.instructions, counted_on(tool, r)});
  return list;
}

std::vector<AcceptedEngine> engines_of(const CaseResult& c) {
  std::vector<AcceptedEngine> list;
  for (const auto& e : c.engines) {
    const bool known = std::any_of(list.begin(), list.end(), [&](const auto& a) { return a.name == e.name; });
    if (!known && is_judged(e)) list.push_back({e.name, one_line(e.version), e.executable_hash});
  }
  return list;
}

const AcceptedGate* counterpart(const std::vector<AcceptedGate>& own, std::size_t index,
                                const std::vector<AcceptedGate>& other) {
  std::size_t before = 0;
  for (std::size_t k = 0; k < index; ++k) before += same_gate(own[k], own[index]);
  for (const auto& g : other)
    if (same_gate(g, own[index]) && before-- == 0) return &g;
  return nullptr;
}

bool is_absent(const CaseResult& c, const AcceptedGate& g, bool engines_were_chosen) {
  const auto row = std::find_if(c.engines.begin(), c.engines.end(), [&](const auto& e) {
    return e.name == g.engine && preset_unless_default(e.preset) == g.preset;
  });
  if (row != c.engines.end()) return row->status == Status::missing;
  const auto of_name =
      std::find_if(c.engines.begin(), c.engines.end(), [&](const auto& e) { return e.name == g.engine; });
  // An engine that is not there has not said which presets it has
  if (of_name != c.engines.end()) return of_name->status == Status::missing;
  return engines_were_chosen;
}

std::vector<const AcceptedGate*> gone(const CaseResult& c, const std::vector<AcceptedGate>& now,
                                      const Baseline& b, bool engines_were_chosen) {
  std::vector<const AcceptedGate*> list;
  for (std::size_t k = 0; k < b.gates.size(); ++k)
    if (!is_absent(c, b.gates[k], engines_were_chosen) && !counterpart(b.gates, k, now))
      list.push_back(&b.gates[k]);
  return list;
}

}  // namespace tripoint
