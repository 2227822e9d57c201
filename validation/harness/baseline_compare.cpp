// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "adapters/job.hpp"
#include "core/durable_file.hpp"
#include "validation/harness/apply_gate.hpp"
#include "validation/harness/baseline.hpp"
#include "validation/harness/slack.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;

double room_of(const Gate& gate) {
  double room = gate.limit.value_or(std::numeric_limits<double>::infinity());
  if (gate.band) room = std::min(room, 0.5 * ((*gate.band)[1] - (*gate.band)[0]));
  if (!std::isfinite(room) && gate.at_least) room = *gate.at_least > 0.0 ? 1.0 / *gate.at_least : std::numeric_limits<double>::infinity();
  return room;
}

namespace {

std::string hash_of(const CaseResult& c) {
  std::ifstream in(c.file, std::ios::binary);
  return text_hash({std::istreambuf_iterator<char>(in), {}});
}

bool same_gate(const AcceptedGate& a, const AcceptedGate& b) {
  const bool same_place = a.level.has_value() == b.level.has_value() && (!a.level || std::abs(*a.level - *b.level) <= 1e-9 * std::abs(*b.level));
  return a.metric == b.metric && a.engine == b.engine && a.preset == b.preset && a.mode == b.mode && same_place;
}

AcceptedGate gate_of(const EngineRow& e, const GateRow& row) {
  AcceptedGate g;
  g.metric = row.expect.empty() ? row.metric : row.metric + " is " + row.expect;
  g.engine = e.name, g.preset = e.preset == "default" ? "" : e.preset, g.mode = row.mode, g.level = row.level;
  g.allows = row.expect.empty() ? describe(row.gate) : "class " + row.expect;
  g.room = row.expect.empty() ? room_of(row.gate) : 1.0;
  g.value = row.value, g.uncertainty = row.uncertainty, g.fit_class = row.fit_class;
  return g;
}

std::string run_name(const EngineRow& e, const RunRow& r) {
  const auto at = r.folder.find("/" + e.name + "/");
  return at == std::string::npos ? e.name + "/" + r.group : r.folder.substr(at + 1);
}

bool is_accepted(const GateRow& row) { return std::isfinite(row.value) && row.verdict == "pass"; }

/// Gates as they stand: two that judge the same row (a limit and a band) are told apart by their order.
std::vector<AcceptedGate> gates_of(const CaseResult& c) {
  std::vector<AcceptedGate> list;
  for (const auto& e : c.engines)
    for (const auto& row : e.gates)
      if (is_accepted(row)) list.push_back(gate_of(e, row));
  return list;
}

std::string counted_on(const Tool& tool, const RunRow& r) {
  return r.cost.instructions > 0.0 ? fmt::format("{}; {}; {}; {}", r.cost.counted_by, tool.cpu, tool.compiler, tool.flags) : std::string();
}

std::vector<AcceptedCost> costs_of(const CaseResult& c, const Tool& tool) {
  std::vector<AcceptedCost> list;
  for (const auto& e : c.engines)
    for (const auto& r : e.runs)
      if (r.status == "ok" && (r.cost.pairs > 0.0 || r.cost.steps > 0.0)) list.push_back({run_name(e, r), r.cost.pairs, r.cost.steps, r.cost.instructions, counted_on(tool, r)});
  return list;
}

std::vector<const AcceptedGate*> matching(const std::vector<AcceptedGate>& list, const AcceptedGate& wanted) {
  std::vector<const AcceptedGate*> found;
  for (const auto& g : list)
    if (same_gate(g, wanted)) found.push_back(&g);
  return found;
}

/// The n-th of those that judge the same row, where n is the place of `g` among its own like.
const AcceptedGate* counterpart(const std::vector<AcceptedGate>& own, std::size_t index, const std::vector<AcceptedGate>& other) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < index; ++k) n += same_gate(own[k], own[index]);
  const auto found = matching(other, own[index]);
  return n < found.size() ? found[n] : nullptr;
}

/// Whether the engine of an accepted gate has run here.
bool is_here(const CaseResult& c, const AcceptedGate& g) {
  const auto e = std::find_if(c.engines.begin(), c.engines.end(), [&](const auto& row) { return row.name == g.engine; });
  return e != c.engines.end() && e->status == "ok";
}

/// Accepted gates of engines that have run here, and that judge nothing any more.
std::vector<const AcceptedGate*> gone(const CaseResult& c, const std::vector<AcceptedGate>& now, const Baseline& b) {
  std::vector<const AcceptedGate*> list;
  for (std::size_t k = 0; k < b.gates.size(); ++k)
    if (is_here(c, b.gates[k]) && !counterpart(b.gates, k, now)) list.push_back(&b.gates[k]);
  return list;
}

}  // namespace

Baseline accepted_from(const CaseResult& c, const Tool& tool, std::uint64_t seed, const Baseline* before, const Acceptance& acceptance) {
  Baseline b;
  b.id = c.id, b.case_hash = hash_of(c), b.seed = seed;
  if (before) b.accepted = before->accepted;
  b.accepted.push_back(acceptance);
  b.gates = gates_of(c), b.cost = costs_of(c, tool);
  const auto own = b.gates;
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto& g = b.gates[k];
    const auto* old = before ? counterpart(own, k, before->gates) : nullptr;
    g.first_room = old ? old->first_room : g.room, g.first_value = old ? old->first_value : g.value;
    if (old) g.loosened = old->loosened + (g.room > old->room && old->room > 0.0 ? std::log(g.room / old->room) : 0.0);
  }
  if (!before) return b;
  b.removed = before->removed + static_cast<int>(gone(c, own, *before).size());
  for (const auto& g : before->gates)  // an engine that is not on this machine keeps what was accepted of it elsewhere
    if (!is_here(c, g)) b.gates.push_back(g);
  return b;
}

namespace {

constexpr double change_seen = 0.1, cost_seen = 0.01;

void compare_gate(const CaseResult& c, const AcceptedGate& now, const SourcePlace& place, const std::optional<double>& drift, const AcceptedGate& old, std::vector<Remark>& list) {
  const std::string title = fmt::format("{} {}{}{} {}", c.id, now.engine, now.mode.empty() ? "" : " ", now.mode, now.metric);
  if (now.room > old.room * (1.0 + 1e-9))
    list.push_back({true, exit_missing, place, title, fmt::format("{} is looser than what was accepted, {}: tripoint gate accept --reason says who decided and why", now.allows, old.allows), now.room / old.room});
  if (now.fit_class != old.fit_class) list.push_back({false, 0, place, title, fmt::format("converges as {}, accepted was {}", now.fit_class, old.fit_class), 1.0});
  if (now.metric.ends_with(".order") || !now.fit_class.empty()) return;
  const double noise = 2.0 * (now.uncertainty + old.uncertainty) + roundoff_limit;
  if (drift) {
    if (std::abs(now.value - old.value) > *drift * std::abs(old.value) + noise)
      list.push_back({true, exit_fail, place, title, fmt::format("{:.6g} has moved from the accepted value {:.6g} by more than the share of {:g} that the gate allows", now.value, old.value, *drift), std::abs(now.value / old.value)});
    return;
  }
  for (const auto& [word, was] : {std::pair{"accepted", old.value}, std::pair{"first", old.first_value}}) {
    const bool one_sided = now.allows.starts_with("limit");
    const double change = one_sided ? std::abs(now.value) - std::abs(was) : std::abs(now.value - was);
    if (change <= change_seen * std::abs(was) + noise) continue;
    list.push_back({false, 0, place, title, fmt::format("{:.4g} {} the {} value {:.4g}", now.value, one_sided ? "is worse than" : "has moved from", word, was), std::abs(now.value / was)});
    return;
  }
}

void compare_cost(const CaseResult& c, const Tool& tool, const Baseline& b, std::vector<Remark>& list) {
  for (const auto& now : costs_of(c, tool)) {
    const auto old = std::find_if(b.cost.begin(), b.cost.end(), [&](const auto& o) { return o.run == now.run; });
    if (old == b.cost.end()) continue;
    const double counted = now.counted_on == old->counted_on ? old->instructions : 0.0;  // another machine takes other vectors, and another count
    for (const auto& [what, is, was] : {std::tuple{"pairs", now.pairs, old->pairs}, std::tuple{"steps", now.steps, old->steps}, std::tuple{"instructions", now.instructions, counted}})
      if (is > 0.0 && was > 0.0 && is > (1.0 + cost_seen) * was)
        list.push_back({true, exit_cost, {c.file, 1, 0}, c.id + " " + now.run, fmt::format("{:.4g} {}, accepted were {:.4g} ({:+.1f} %)", is, what, was, 100.0 * (is / was - 1.0)), is / was});
  }
}

}  // namespace

namespace {

void compare_case(const Results& results, const CaseResult& c, const Baseline& b, std::vector<Remark>& list) {
  if (b.case_hash != hash_of(c)) list.push_back({false, 0, {c.file, 1, 0}, c.id, "the case file has changed since its figures were accepted", 1.0});
  const auto now = gates_of(c);
  std::size_t k = 0;
  for (const auto& e : c.engines)
    for (const auto& row : e.gates)
      if (is_accepted(row)) {
        if (const auto* old = counterpart(now, k, b.gates)) compare_gate(c, now[k], row.gate.place, row.gate.drift, *old, list);
        ++k;
      }
  if (c.exit_code == exit_pass)  // a red gate is no gate that is gone
    for (const auto* g : gone(c, now, b))
      list.push_back({true, exit_missing, {c.file, 1, 0}, fmt::format("{} {}{}{} {}", c.id, g->engine, g->mode.empty() ? "" : " ", g->mode, g->metric),
                      fmt::format("was accepted with {} and judges nothing any more: tripoint gate accept --reason says who decided and why", g->allows), std::numeric_limits<double>::infinity()});
  if (b.seed == results.seed) compare_cost(c, results.tool, b, list);
}

/// One sentence for all: a suite that begins to keep baselines is not told a hundred times.
Remark none_yet(const std::vector<const CaseResult*>& cases) {
  constexpr std::size_t named = 5;
  std::string text = fmt::format("{} cases have no baseline yet (tripoint gate accept --reason TEXT RESULTS.json ID): ", cases.size());
  for (std::size_t k = 0; k < std::min(named, cases.size()); ++k) text += (k > 0 ? ", " : "") + cases[k]->id;
  if (cases.size() > named) text += fmt::format(" and {} more", cases.size() - named);
  return {false, 0, {}, "baselines", text, 1.0};
}

}  // namespace

std::vector<Remark> baseline_remarks(const Results& results, bool required) {
  std::vector<Remark> list;
  std::vector<const CaseResult*> without;
  for (const auto& c : results.cases) {
    if (!required && !keeps_baselines(c.file)) continue;
    const auto file = baseline_file(c.file);
    if (fs::exists(file)) compare_case(results, c, read_baseline(file), list);
    else if (required) list.push_back({true, exit_missing, {c.file, 1, 0}, c.id, "has no baseline: tripoint gate accept --reason TEXT RESULTS.json " + c.id, std::numeric_limits<double>::infinity()});
    else without.push_back(&c);
  }
  if (!without.empty()) list.push_back(none_yet(without));
  return list;
}

namespace {

/// What acceptance changes of one case: each gate whose room or value has moved.
std::string changes(const Baseline* before, const Baseline& after) {
  if (!before) return fmt::format("{}: first baseline, {} gates\n", after.id, after.gates.size());
  std::string text;
  for (std::size_t k = 0; k < after.gates.size(); ++k) {
    const auto& now = after.gates[k];
    const auto* old = counterpart(after.gates, k, before->gates);
    const std::string name = fmt::format("{} {}{}{} {}{}", after.id, now.engine, now.mode.empty() ? "" : " ", now.mode, now.metric, now.level ? fmt::format(" at {:g}", *now.level) : "");
    if (!old) text += fmt::format("{}: new, {}\n", name, now.allows);
    else if (std::abs(now.room / old->room - 1.0) > 1e-9)
      text += fmt::format("{}: {} -> {}, {} by a factor {:.3g}\n", name, old->allows, now.allows, now.room > old->room ? "LOOSER" : "tighter", std::max(now.room / old->room, old->room / now.room));
    else if (std::abs(now.value - old->value) > 1e-3 * std::abs(old->value) + roundoff_limit) text += fmt::format("{}: value {:.4g} -> {:.4g}\n", name, old->value, now.value);
  }
  return text;
}

double loosenings(const Baseline& b, int& count) {
  double sum = 0.0;
  for (const auto& g : b.gates) sum += g.loosened, count += g.loosened > 0.0;
  return sum;
}

void check_acceptable(const CaseResult& c) {
  if (c.exit_code != exit_pass) throw InputError(fmt::format("{}: is {} and cannot be accepted; what is measured must be green first", c.id, c.verdict));
}

}  // namespace

std::string accept(const Results& results, const std::vector<std::string>& ids, const Acceptance& acceptance) {
  if (acceptance.reason.find_first_not_of(" \t\n") == std::string::npos) throw InputError("gate accept: --reason says who decided what, and why");
  std::vector<const CaseResult*> chosen;
  for (const auto& c : results.cases)
    if (ids.empty() || std::find(ids.begin(), ids.end(), c.id) != ids.end()) chosen.push_back(&c);
  for (const auto& id : ids)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const auto* c) { return c->id == id; })) throw InputError(id + ": the results hold no case of this id");
  for (const auto* c : chosen) check_acceptable(*c);
  std::string text;
  double sum = 0.0;
  int count = 0, removed = 0;
  for (const auto* c : chosen) {
    const auto file = baseline_file(c->file);
    std::optional<Baseline> before;
    if (fs::exists(file)) before = read_baseline(file);
    const auto after = accepted_from(*c, results.tool, results.seed, before ? &*before : nullptr, acceptance);
    fs::create_directories(fs::path(file).parent_path());
    write_durably(file, baseline_text(after));
    text += changes(before ? &*before : nullptr, after);
    if (before)
      for (const auto* g : gone(*c, gates_of(*c), *before)) text += fmt::format("{} {} {} {}: REMOVED, it was {}\n", c->id, g->engine, g->mode, g->metric, g->allows);
    sum += loosenings(after, count), removed += after.removed;
  }
  return text + fmt::format("{} cases accepted; since the first baseline {} limits were loosened, in all by a factor {:.4g} (sum of ln new/old {:.3g}), and {} were removed\n", chosen.size(), count, std::exp(sum), sum, removed);
}

}  // namespace tripoint
