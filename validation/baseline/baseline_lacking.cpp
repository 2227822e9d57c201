// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline_lacking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "validation/baseline/baseline_rows.hpp"
#include "validation/case/case_words.hpp"
#include "validation/results/escaped_text.hpp"

namespace tripoint {
namespace {

std::string with_preset(const AcceptedGate& g) {
  return g.preset.empty() ? g.engine : g.engine + " " + g.preset;
}

std::string engine_of(const AcceptedCost& cost) { return cost.run.substr(0, cost.run.find('/')); }

/// What was accepted of engines that did not run here, and accepted gates that judge nothing any more.
struct Missing {
  std::set<std::string> engines;
  std::vector<const AcceptedGate*> absent, gone;
  /// Of engines that did run: ended early now, or (ok) no run at all
  std::map<const AcceptedCost*, Status> runs;
};

/// Accepted runs of engines that are there, and that the results do not have as whole runs.
std::map<const AcceptedCost*, Status> runs_missing_from(const CaseResult& c, const Baseline& before,
                                                        const Baseline& after,
                                                        const std::set<std::string>& absent) {
  std::map<const AcceptedCost*, Status> list;
  for (const auto& run : before.cost)
    if (!absent.contains(engine_of(run)) &&
        std::ranges::find(after.cost, run.run, &AcceptedCost::run) == after.cost.end())
      list[&run] = Status::ok;
  for (const auto& e : c.engines)
    for (const auto& r : e.runs)
      for (auto& [run, status] : list)
        if (run->run == run_name(e, r)) status = r.status;
  return list;
}

Missing missing_from(const CaseResult& c, const Baseline& before, const Baseline& after,
                     bool engines_were_chosen) {
  Missing m;
  m.gone = gone(c, gates_of(c, {}), before, engines_were_chosen);
  for (const auto& g : before.gates)
    if (is_absent(c, g, engines_were_chosen)) {
      m.absent.push_back(&g);
      m.engines.insert(g.engine);
    }
  const auto note = [&](const std::string& name) {
    AcceptedGate any;
    any.engine = name;
    if (is_absent(c, any, engines_were_chosen)) m.engines.insert(name);
  };
  for (const auto& e : before.engines) note(e.name);
  for (const auto& run : before.cost) note(engine_of(run));
  m.runs = runs_missing_from(c, before, after, m.engines);
  return m;
}

bool has_early_ends(const Missing& m) {
  return std::ranges::any_of(m.runs, [](const auto& run) { return run.second != Status::ok; });
}

/// "jolt (energy, spin), lammps (no gate)".
std::string names_of(const Missing& m, bool with_absent) {
  std::map<std::string, std::set<std::string>> metrics;
  if (with_absent)
    for (const auto& name : m.engines) metrics[name];
  for (const auto* g : m.gone) metrics[with_preset(*g)].insert(g->metric);
  for (const auto& [run, status] : m.runs)
    if (status != Status::ok)
      metrics[engine_of(*run)].insert(
          fmt::format("{}: {}", run->run.substr(run->run.find('/') + 1), to_string(status)));
  if (with_absent)
    for (const auto* g : m.absent) metrics[g->engine].insert(g->metric);
  std::string text;
  for (const auto& [engine, of] : metrics)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", engine,
                        of.empty() ? "no gate" : fmt::format("{}", fmt::join(of, ", ")));
  return text;
}

void refuse(const Baseline& before, const Missing& m, bool kept, bool same_scene) {
  throw InputError(one_line(fmt::format(
      "{}: the results lack what was accepted of {}: validate with all of them (tripoint engines lists those "
      "that are here), or "
      "say --drop-missing and, in --reason, why it goes{}",
      before.id, names_of(m, !kept),
      kept || m.engines.empty() ? ""
      : same_scene ? "; --keep-missing leaves the rows of engines that did not run as they were accepted"
                   : "; --keep-missing cannot help, since scene or reference have changed")));
}

void keep(const Baseline& before, const Missing& m, Baseline& after) {
  for (const auto* g : m.absent) after.gates.push_back(*g);
  for (const auto& e : before.engines)
    if (m.engines.contains(e.name)) after.engines.push_back(e);
  for (const auto& run : before.cost)
    if (m.engines.contains(engine_of(run))) after.cost.push_back(run);
}

std::string removed_gates(const Baseline& before, const std::vector<const AcceptedGate*>& gates) {
  std::string text;
  for (const auto* g : gates)
    text += one_line(fmt::format("{} {}{} {}: REMOVED, it was {}", before.id, with_preset(*g),
                                 after_blank(g->mode), g->metric, g->allows)) +
            "\n";
  return text;
}

std::string removed_runs(const Baseline& before, const Missing& m) {
  std::string text;
  for (const auto& [run, status] : m.runs)
    text += one_line(fmt::format("{} {}: REMOVED, {}", before.id, run->run,
                                 status == Status::ok ? "there is no such run" : to_string(status))) +
            "\n";
  return text;
}

}  // namespace

std::string carry_over(const CaseResult& c, const Baseline& before, Baseline& after, const Lacking& lacking,
                       bool engines_were_chosen) {
  const auto m = missing_from(c, before, after, engines_were_chosen);
  const bool same_scene = before.scene == after.scene && before.reference == after.reference;
  const bool kept = lacking.keep && same_scene;
  if (!lacking.drop && (!m.gone.empty() || has_early_ends(m) || (!kept && !m.engines.empty())))
    refuse(before, m, kept, same_scene);
  auto text = removed_runs(before, m) + removed_gates(before, m.gone);
  after.removed += static_cast<int>(m.gone.size());
  if (kept) {
    keep(before, m, after);
    return text;
  }
  after.removed += static_cast<int>(m.absent.size());
  for (const auto& name : m.engines)
    text += one_line(fmt::format("{} {}: REMOVED with its runs", before.id, name)) + "\n";
  return text + removed_gates(before, m.absent);
}

}  // namespace tripoint
