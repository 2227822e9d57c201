// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/adopt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/mutation/seeds.hpp"
#include "validation/publish/releases.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr double single_round_off = 1e-5, double_round_off = 1e-11;
constexpr std::uint64_t seeds_apart = 1000;  // from the case's own, beyond those of its studies

double round_off_of(const EngineEntry& engine) {
  return engine.build.find("single") == std::string::npos ? double_round_off : single_round_off;
}

/// One run of the whole case with one seed; the trajectories are not kept.
CaseResult run_once(const Case& value, const EngineEntry& engine, const AdoptOptions& o,
                    const std::string& name, std::optional<std::uint64_t> seed) {
  SuiteOptions suite;
  suite.selection.engines = {engine.name};
  suite.selection.seed = seed;
  suite.jobs = o.jobs;
  suite.out = (fs::path(o.work) / name).string();
  if (name != "first")  // orders are of the first run
    suite.wanted = [](const EnginePlan&, const RunPlan& run) { return run.base; };
  auto results = run_suite({value}, {engine}, suite);
  fs::remove_all(fs::path(suite.out) / "runs" / value.id);
  if (results.cases.empty()) throw EngineError("interrupted");
  return results.cases.front();
}

const RunRow* run_of(const CaseResult& c, const std::string& preset) {
  for (const auto& e : c.engines)
    if (e.preset == preset) return base_run(e);
  return nullptr;
}

bool has_chance(const Case& value, const EngineEntry& engine) {
  Selection selection;
  selection.engines = {engine.name};
  for (const auto& plan : plan_runs(value, {engine}, selection))
    for (const auto& run : plan.runs)
      if (run.base && depends_on_seed(value, plan, run)) return true;
  return false;
}

/// What differs between a run and its repeat; empty = nothing does.
std::string difference(const RunRow& a, const RunRow& b) {
  if (a.status != b.status) return fmt::format("one run is {} and its repeat {}", a.status, b.status);
  for (const auto& [name, value] : a.metrics) {
    const auto again = b.metrics.find(name);
    if (again == b.metrics.end() || !std::isfinite(value.value) || value.value == again->second.value)
      continue;
    return fmt::format("{} is {:.9g} in one run and {:.9g} in its repeat", name, value.value,
                       again->second.value);
  }
  if (!a.state_hash.empty() && a.state_hash != b.state_hash)
    return "the state of one run and that of its repeat differ";
  return {};
}

bool repeats_itself(const CaseResult& first, const CaseResult& again) {
  return std::all_of(first.engines.begin(), first.engines.end(), [&](const auto& e) {
    const auto *a = base_run(e), *b = run_of(again, e.preset);
    return !a || !b || difference(*a, *b).empty();
  });
}

/// The first run, its repeat, and more where chance has a hand: by the seed, or by an engine that does not
/// repeat itself.
std::vector<CaseResult> run_all(const Case& value, const EngineEntry& engine, const AdoptOptions& o) {
  std::vector<CaseResult> runs{run_once(value, engine, o, "first", {})};
  const bool ran = std::any_of(runs[0].engines.begin(), runs[0].engines.end(), [](const auto& e) {
    return base_run(e) && base_run(e)->status == Status::ok;
  });
  if (!ran) return runs;
  runs.push_back(run_once(value, engine, o, "repeat", {}));
  const int more = has_chance(value, engine) || !repeats_itself(runs[0], runs[1]) ? o.seeds : 0;
  for (int k = 0; k < more; ++k)
    runs.push_back(
        run_once(value, engine, o, "seed", value.scene.seed + seeds_apart + static_cast<std::uint64_t>(k)));
  return runs;
}

/// Values of one metric over all runs: not finite where a run has none.
Measured measured_in(const std::vector<CaseResult>& runs, const std::string& preset,
                     const std::string& metric) {
  Measured m;
  for (const auto& c : runs) {
    const auto* run = run_of(c, preset);
    const auto value = run && run->status == Status::ok ? measured(*run, metric) : std::nullopt;
    m.values.push_back(value ? value->value : not_a_number);
    if (value) m.uncertainty = std::max(m.uncertainty, value->uncertainty.combined());
  }
  return m;
}

std::string note_of(const RunRow& run, const std::string& metric) {
  const auto at = run.metrics.find(metric);
  return at == run.metrics.end() || at->second.note.empty() ? std::string() : ": " + at->second.note;
}

void adopt_metric(AdoptedRow& row, const RunRow& base, const std::string& metric, const Measured& m,
                  double margin, double round_off) {
  if (!std::all_of(m.values.begin(), m.values.end(), [](double v) { return std::isfinite(v); })) {
    row.findings.push_back(
        {exit_missing, fmt::format("{} has no finite value{}", metric, note_of(base, metric)), false});
    return;
  }
  if (const auto noisy = noise_exceeds_value(metric, m, round_off); !noisy.empty())
    row.findings.push_back({exit_inconclusive, noisy, true});
  auto gate = adopted_gate(metric, m, margin, round_off);
  if (!base.levels.empty()) gate.level = base.levels.begin()->second;
  row.gates.push_back(gate);
}

void adopt_orders(AdoptedRow& row, const EngineRow& first) {
  for (const auto& order : first.order)
    if (std::isfinite(order.order.low) && std::isfinite(order.order.high) &&
        order.order.fit_class != FitClass::roundoff && order.order.fit_class != FitClass::noise_limited)
      row.gates.push_back(adopted_order_gate(order));
}

int code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::fail:
      return exit_fail;
    case Verdict::inconclusive:
      return exit_inconclusive;
    case Verdict::diverged:
      return exit_diverged;
    default:
      return exit_missing;
  }
}

AdoptFinding failure(const GateRow& row) {
  const bool measured = row.verdict == Verdict::fail || row.verdict == Verdict::inconclusive;
  return {code_of(row.verdict),
          fmt::format("{}{} fails a limit that holds for any engine: {}", row.metric,
                      row.level ? fmt::format(" at {:g}", *row.level) : "", row.why),
          measured};
}

/// Limits that hold for any engine: those that it holds stay in the case, the others are findings.
void adopt_acceptance(AdoptedRow& row, const EngineRow& first, const std::vector<Gate>& acceptance) {
  for (const auto& g : first.gates)
    if (g.verdict != Verdict::pass) row.findings.push_back(failure(g));
  for (const auto& gate : acceptance) {
    bool judged = false, held = true;
    for (const auto& g : first.gates) {
      if (g.expect || g.gate.place.line != gate.place.line || g.gate.place.file != gate.place.file) continue;
      judged = true;
      held = held && g.verdict == Verdict::pass;
    }
    if (!judged || !held) continue;
    row.gates.push_back(gate);
    row.gates.back().mode = JudgedMode::none;
  }
  if (first.gates.empty())
    row.findings.push_back(
        {exit_missing, "no limit of the case holds for any engine: nothing says that its values are right",
         true});
}

void adopt_ended(AdoptedRow& row, const EngineRow& first) {
  row.status = first.status;
  row.reason = first.reason;
  if (row.status == Status::ok || row.status == Status::refused || row.status == Status::missing) return;
  const int code = row.status == Status::diverged ? exit_diverged : exit_missing;
  row.findings.push_back({code, fmt::format("a run ended as {}: {}", row.status, row.reason), false});
}

/// Studies of other engines are not written. A gate on a level of theirs means the case's own run, by its
/// level in a study of this engine; where it has none, every run is the case's own.
void settle_level(Gate& gate, const RunRow& base, const std::vector<Study>& studies,
                  const std::string& engine) {
  if (!gate.level) return;
  std::optional<double> own;
  for (const auto& s : studies) {
    if (!applies(s, engine, base.knobs.mode)) continue;
    if (std::any_of(s.levels.begin(), s.levels.end(), [&](double l) { return same_level(l, *gate.level); }))
      return;
    if (const auto at = base.levels.find(s.axes); at != base.levels.end()) own = at->second;
  }
  gate.level = own;
}

AdoptedRow row_of(const std::vector<CaseResult>& runs, const EngineRow& first, const EngineEntry& engine,
                  const AdoptOptions& o) {
  AdoptedRow row;
  row.preset = first.preset;
  adopt_ended(row, first);
  const auto* base = base_run(first);
  if (!base || base->status != Status::ok || !base->comparable || runs.size() < 2) return row;
  const auto* again = run_of(runs[1], row.preset);
  if (const auto other = again ? difference(*base, *again) : std::string();
      engine.deterministic && !other.empty())
    row.findings.push_back(
        {exit_fail,
         fmt::format("{} says that it is deterministic, and that is untrue: {}", engine.name, other), true});
  for (const auto& metric : runs.front().metrics)
    adopt_metric(row, *base, metric.name, measured_in(runs, row.preset, metric.name), o.margin,
                 round_off_of(engine));
  adopt_orders(row, first);
  adopt_acceptance(row, first, runs.front().gates);
  for (auto& gate : row.gates) settle_level(gate, *base, runs.front().studies, engine.name);
  return row;
}

void sign_gates(AdoptedCase& adopted, const EngineEntry& engine, const AdoptOptions& o) {
  for (auto& row : adopted.rows)
    for (auto& gate : row.gates) {
      gate.engine = engine.name;
      gate.preset = adopted.rows.size() > 1 ? row.preset : preset_unless_default(row.preset);
      gate.date = o.date;
    }
}

void say_outcome(const AdoptedCase& c, const EngineEntry& engine, void (*say)(const std::string&)) {
  for (const auto& row : c.rows)
    say(fmt::format("{} {}: {}", c.id, label_of(engine.name, row.preset),
                    row.status == Status::ok ? fmt::format("{} gates", row.gates.size())
                                             : fmt::format("{}, {}", row.status, row.reason)));
}

AdoptedCase measure_one(const Case& source, const EngineEntry& engine, const AdoptOptions& o) {
  AdoptedCase adopted{source.id, source.file, {}, {}};
  if (source.expect != Expect::pass) {
    adopted.findings.push_back(
        {exit_bad_input, "declares a defect or a divergence, and such a case is not adopted", false});
    return adopted;
  }
  const auto runs = run_all(case_to_adopt(source, engine), engine, o);
  for (const auto& e : runs[0].engines)
    if (e.name == engine.name) adopted.rows.push_back(row_of(runs, e, engine, o));
  sign_gates(adopted, engine, o);
  return adopted;
}

/// Presets of an engine that the case does not list are all of them, as `validate` takes them.
std::vector<std::string> presets_for(const Case& value, const EngineEntry& engine) {
  const auto at = std::find_if(value.engines.begin(), value.engines.end(),
                               [&](const auto& e) { return e.name == engine.name; });
  if (at != value.engines.end()) return at->presets;
  return suits_itself_to_the_scene(engine.name) ? std::vector<std::string>() : engine.presets;
}

}  // namespace

bool AdoptedCase::judged() const {
  return std::any_of(rows.begin(), rows.end(), [](const auto& r) { return !r.gates.empty(); });
}

std::vector<AdoptFinding> AdoptedCase::all_findings() const {
  auto all = findings;
  for (const auto& row : rows)
    for (auto f : row.findings) {
      if (!is_default_preset(row.preset)) f.text = fmt::format("preset {}: {}", row.preset, f.text);
      all.push_back(f);
    }
  return all;
}

std::set<int> AdoptedCase::refused_by(const std::string& despite) const {
  std::set<int> codes;
  for (const auto& f : all_findings())
    if (!f.excusable || despite.empty()) codes.insert(f.code);
  return codes;
}

Case case_to_adopt(Case value, const EngineEntry& engine) {
  EngineChoice choice, ours;
  choice.name = engine.name;
  choice.presets = presets_for(value, engine);
  for (const auto& e : value.engines)
    if (e.name == engine.name) choice.settings = e.settings;
  choice.settings.erase("refuses");
  choice.required = true;
  ours.name = engine_name::solver;
  std::erase_if(value.engines, [](const auto& e) { return e.name != "all"; });
  value.engines.push_back(choice);
  if (!is_own_solver(engine.name)) value.engines.push_back(ours);
  value.modes = {Mode::corrected};
  std::erase_if(value.gates, [](const Gate& g) { return !g.engine.empty() || g.mode == JudgedMode::paper; });
  value.defects.clear();
  value.harmless.clear();
  return value;
}

std::vector<AdoptedCase> measure_to_adopt(const std::vector<Case>& cases, const EngineEntry& engine,
                                          const AdoptOptions& o, void (*say)(const std::string&)) {
  std::vector<AdoptedCase> list;
  for (const auto& source : cases) {
    list.push_back(measure_one(source, engine, o));
    say_outcome(list.back(), engine, say);
  }
  return list;
}

}  // namespace tripoint
