// SPDX-License-Identifier: BSD-3-Clause
#include "validation/mutation/seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/errors.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

// From the case's own seed, beyond those of its studies' replicas
constexpr std::uint64_t seeds_apart = 1000;

/// @param taken places in all.gates that this seed has filled: gates of the same level of two studies are
/// told apart by their order
SeedOutcome& outcome_for(const CaseResult& c, const EngineRow& e, const GateRow& row, SeedsOutcome& all,
                         std::set<const SeedOutcome*>& taken) {
  const auto allows = row.expect ? fmt::format("class {}", *row.expect) : describe(row.gate);
  for (auto& g : all.gates)
    if (!taken.count(&g) && g.case_id == c.id && g.engine == label_of(e.name, e.preset) &&
        g.mode == row.mode && g.metric == row.metric && g.level == row.level && g.allows == allows) {
      taken.insert(&g);
      return g;
    }
  SeedOutcome g;
  g.case_id = c.id;
  g.engine = label_of(e.name, e.preset);
  g.mode = row.mode;
  g.metric = row.metric;
  g.allows = allows;
  g.level = row.level;
  g.gate = row.gate;
  all.gates.push_back(g);
  taken.insert(&all.gates.back());
  return all.gates.back();
}

/// Distance from a value to the nearest edge of the gate.
double headroom(const Gate& gate, double value) {
  double least = std::numeric_limits<double>::infinity();
  if (gate.limit) least = std::min(least, *gate.limit - std::abs(value));
  if (gate.at_least) least = std::min(least, value - *gate.at_least);
  if (gate.band) least = std::min({least, value - (*gate.band)[0], (*gate.band)[1] - value});
  return least;
}

/// "-" where the seed changes nothing, or nothing but round-off.
std::string headroom_text(const SeedOutcome& g) {
  constexpr double round_off = 1e5;
  return std::isfinite(g.distance) && g.distance < round_off ? fmt::format("{:.1f}", g.distance) : "-";
}

}  // namespace

bool depends_on_seed(const Case& value, const EnginePlan& engine, const RunPlan& run) {
  if (is_exact(engine.name)) return false;
  return run.walkers.has_value() || (engine.entry && !engine.entry->deterministic) ||
         scene_of(value, run).jitter > 0.0;
}

void add_seed(const CaseResult& c, std::uint64_t seed, SeedsOutcome& all) {
  std::set<const SeedOutcome*> taken;
  for (const auto& e : c.engines) {
    for (const auto& run : e.runs)
      if (run.status != Status::ok && run.status != Status::refused && run.status != Status::missing &&
          !(run.status == Status::diverged && may_diverge(c, run.knobs.mode)))
        all.problems.push_back(fmt::format("{} {} seed {}: {} {}", c.id, label_of(e.name, e.preset), seed,
                                           run.status, run.reason));
    for (const auto& row : e.gates) {
      if (row.verdict == Verdict::missing) continue;  // a level that chance has no hand in
      auto& g = outcome_for(c, e, row, all, taken);
      g.values.push_back(row.value);
      if (row.verdict != Verdict::pass) g.alarms.push_back(seed);
    }
  }
}

void settle(SeedsOutcome& all) {
  bool alarm = !all.problems.empty();
  for (auto& g : all.gates) {
    const double n = static_cast<double>(g.values.size());
    double sum = 0.0, squares = 0.0;
    for (const double v : g.values) sum += v / n;
    for (const double v : g.values) squares += (v - sum) * (v - sum);
    g.mean = sum;
    g.deviation = n > 1.0 ? std::sqrt(squares / (n - 1.0)) : not_a_number;
    g.distance = g.deviation > 0.0 ? headroom(g.gate, g.mean) / g.deviation : not_a_number;
    alarm = alarm || !g.alarms.empty();
  }
  all.exit_code = alarm ? exit_selftest : exit_pass;
}

SeedsOutcome try_seeds(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines, int count,
                       const SelftestOptions& o) {
  SeedsOutcome all;
  all.seeds = count;
  for (const auto& value : cases) {
    const auto plans = plan_runs(value, engines, {});
    const auto chance = [&](const EnginePlan& e) {
      return e.entry && std::any_of(e.runs.begin(), e.runs.end(),
                                    [&](const RunPlan& r) { return depends_on_seed(value, e, r); });
    };
    if (std::none_of(plans.begin(), plans.end(), chance)) continue;
    all.cases.push_back(value.id);
    for (int k = 1; k <= count; ++k) {
      SuiteOptions suite;
      suite.jobs = o.jobs;
      suite.say = o.say;
      suite.out = (fs::path(o.out) / "seeds").string();
      suite.selection.seed = value.scene.seed + seeds_apart * static_cast<std::uint64_t>(k);
      suite.wanted = [&](const EnginePlan& e, const RunPlan&) {
        return chance(e);
      };  // all of its runs: an order may need those that do not change
      const auto results = run_suite({value}, engines, suite);
      if (results.cases.empty()) throw EngineError("interrupted");
      add_seed(results.cases.front(), *suite.selection.seed, all);
      // Twenty times the trajectories would be kept for nothing
      fs::remove_all(fs::path(suite.out) / "runs" / value.id);
    }
  }
  if (all.cases.empty()) throw InputError("no case depends on a seed: nothing was proven");
  settle(all);
  return all;
}

std::string seeds_table(const SeedsOutcome& all) {
  std::string text = fmt::format(
      "{} other seeds; `headroom` is from the mean to the nearest edge of what is allowed, in standard "
      "deviations over seeds\n",
      all.seeds);
  text += fmt::format("{:6} {:24} {:18} {:10} {:24} {:>10} {:>9} {:>8}  {}\n", "", "case", "engine", "mode",
                      "metric", "mean", "deviation", "headroom", "allowed");
  std::size_t alarms = 0;
  for (const auto& g : all.gates) {
    alarms += g.alarms.size();
    text += one_line(fmt::format(
                "{:6} {:24} {:18} {:10} {:24} {:10.4g} {:9.2g} {:>8}  {}{}{}",
                g.alarms.empty() ? "quiet" : "ALARM", g.case_id, g.engine, g.mode, g.metric, g.mean,
                g.deviation, headroom_text(g), g.allows, g.level ? fmt::format(" at {:g}", *g.level) : "",
                g.alarms.empty() ? ""
                                 : fmt::format("  {} of {}: seeds {} ({})", g.alarms.size(), g.values.size(),
                                               fmt::join(g.alarms, ", "), to_string(g.gate.place)))) +
            "\n";
  }
  for (const auto& p : all.problems) text += "PROBLEM " + one_line(p) + "\n";
  return text + fmt::format("{} cases, {} gates, {} seeds: {} false alarms, exit {}\n", all.cases.size(),
                            all.gates.size(), all.seeds, alarms, all.exit_code);
}

std::string seeds_json(const SeedsOutcome& all) {
  using Json = nlohmann::ordered_json;
  Json gates = Json::array();
  for (const auto& g : all.gates) {
    gates.push_back({{"case", g.case_id},
                     {"engine", g.engine},
                     {"mode", g.mode},
                     {"metric", g.metric},
                     {"level", json_number(g.level)},
                     {"allows", g.allows},
                     {"values", json_numbers(g.values)},
                     {"mean", json_number(g.mean)},
                     {"deviation", json_number(g.deviation)},
                     {"room_in_deviations", json_number(g.distance)},
                     {"alarms", g.alarms},
                     {"file", g.gate.place.file},
                     {"line", g.gate.place.line}});
  }
  return json_text(Json{{"format", 1},
                        {"seeds", all.seeds},
                        {"exit_code", all.exit_code},
                        {"cases", all.cases},
                        {"gates", gates},
                        {"problems", all.problems}});
}

}  // namespace tripoint
