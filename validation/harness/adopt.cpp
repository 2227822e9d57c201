// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/adopt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/releases.hpp"
#include "validation/harness/seeds.hpp"
#include "validation/harness/suite.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr double single_round_off = 1e-5, double_round_off = 1e-11;
constexpr double least_limit = 1e-10;        // a limit of round-off, of which no slack is asked
constexpr double round_off_room = 3.0;       // another machine rounds otherwise
constexpr double noise_room = 4.0;           // standard deviations over repeats and seeds
constexpr double order_room = 0.2;           // beyond the interval of a fitted order
constexpr std::uint64_t seeds_apart = 1000;  // from the case's own, beyond those of its studies

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread s;
  const double n = static_cast<double>(values.size());
  for (const double v : values) s.mean += v / n;
  for (const double v : values) s.deviation += (v - s.mean) * (v - s.mean);
  s.deviation = n > 1.0 ? std::sqrt(s.deviation / (n - 1.0)) : 0.0;
  return s;
}

/// One run of the whole case with one seed; the trajectories are not kept.
CaseResult run_once(const Case& value, const EngineEntry& engine, const AdoptOptions& o, const std::string& name,
                    std::optional<std::uint64_t> seed) {
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

bool has_chance(const Case& value, const EngineEntry& engine) {
  Selection selection;
  selection.engines = {engine.name};
  for (const auto& plan : plan_runs(value, {engine}, selection))
    for (const auto& run : plan.runs)
      if (run.base && depends_on_seed(value, plan, run)) return true;
  return false;
}

const RunRow* run_of(const CaseResult& c, const std::string& preset) {
  for (const auto& e : c.engines)
    if (e.preset == preset) return base_run(e);
  return nullptr;
}

AdoptedRow row_of(const std::vector<CaseResult>& runs, const EngineRow& first, const EngineEntry& engine, const AdoptOptions& o) {
  AdoptedRow row;
  row.preset = first.preset;
  row.status = first.status;
  row.reason = first.reason;
  const auto* base = base_run(first);
  if (!base || base->status != Status::ok || !base->comparable) return row;
  const double round_off = engine.build.find("single") == std::string::npos ? double_round_off : single_round_off;
  for (const auto& metric : runs.front().metrics) {
    std::vector<double> values;
    double uncertainty = 0.0;
    for (const auto& c : runs) {
      const auto* run = run_of(c, first.preset);
      const auto value = run && run->status == Status::ok ? measured(*run, metric.name) : std::nullopt;
      values.push_back(value ? value->value : not_a_number);
      if (value) uncertainty = std::max(uncertainty, value->uncertainty.combined());
    }
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
      row.lost.push_back(metric.name);
      continue;
    }
    if (engine.deterministic && values.size() > 1 && values[0] != values[1])
      row.notes.push_back(fmt::format("{} says that it is deterministic, and {} is {:.9g} in one run and {:.9g} in its repeat",
                                      engine.name, metric.name, values[0], values[1]));
    auto gate = adopted_gate(metric.name, values, uncertainty, o.margin, round_off);
    if (!base->levels.empty()) gate.level = base->levels.begin()->second;
    row.gates.push_back(gate);
  }
  for (const auto& order : first.order)
    if (std::isfinite(order.order.low) && std::isfinite(order.order.high) && order.order.fit_class != FitClass::roundoff &&
        order.order.fit_class != FitClass::noise_limited)
      row.gates.push_back(adopted_order_gate(order));
  for (auto& gate : row.gates) {
    gate.engine = engine.name;
    gate.preset = preset_unless_default(row.preset);
    gate.date = o.date;
  }
  return row;
}

}  // namespace

bool AdoptedCase::judged() const {
  return std::any_of(rows.begin(), rows.end(), [](const auto& r) { return !r.gates.empty(); });
}

Gate adopted_gate(const std::string& metric, const std::vector<double>& values, double uncertainty, double margin,
                  double round_off) {
  Gate gate;
  gate.metric = metric;
  const auto s = spread_of(values);
  const double noise = noise_room * s.deviation + 2.0 * uncertainty, size = std::abs(s.mean);
  const double apart = values.size() > 1 ? std::abs(values[1] - values[0]) : 0.0;
  const std::string measured = fmt::format(
      "adopted: {:.4g} measured, {:.2g} apart in a repeat{}", values.front(), apart,
      values.size() > 2 ? fmt::format(", standard deviation {:.2g} over {} runs and seeds", s.deviation, values.size()) : "");
  if (size <= round_off) {
    gate.limit = std::max({least_limit, round_off_room * size, size + noise});
    gate.reason = measured + "; an error of round-off may be anything smaller";
    return gate;
  }
  const double low = size / margin - noise, high = size * margin + noise;
  gate.band = s.mean > 0.0 ? std::array{low, high} : std::array{-high, -low};
  gate.reason = fmt::format("{}; room by a factor of {:g} to either side{}", measured, margin,
                            noise > 0.0 ? fmt::format(", and {:.2g} for the noise", noise) : "");
  return gate;
}

Gate adopted_order_gate(const OrderRow& order) {
  Gate gate;
  const auto& o = order.order;
  gate.metric = order.metric + ".order";
  gate.band = std::array{o.low - order_room, o.high + order_room};
  gate.reason = fmt::format("adopted: observed order {:.3g}, 95 % interval {:.3g} to {:.3g}; room of {:g} beyond it", o.value,
                            o.low, o.high, order_room);
  return gate;
}

Case case_to_adopt(Case value, const EngineEntry& engine) {
  EngineChoice choice;
  choice.name = engine.name;
  choice.required = true;
  for (const auto& e : value.engines)
    if (e.name == engine.name) {
      choice.presets = e.presets;
      choice.settings = e.settings;
    }
  EngineChoice ours;
  ours.name = engine_name::solver;
  value.engines = {choice};
  if (!is_own_solver(engine.name)) value.engines.push_back(ours);
  value.modes = {Mode::corrected};
  value.gates.clear();
  value.defects.clear();
  value.harmless.clear();
  std::erase_if(value.studies, [](const Study& s) {
    return !s.engine.empty() || (s.mode != JudgedMode::none && s.mode != JudgedMode::not_paper);
  });
  for (auto& s : value.studies) {
    s.expect.reset();
    s.mode = JudgedMode::none;
  }
  return value;
}

std::vector<AdoptedCase> measure_to_adopt(const std::vector<Case>& cases, const EngineEntry& engine, const AdoptOptions& o,
                                          void (*say)(const std::string&)) {
  std::vector<AdoptedCase> list;
  for (const auto& source : cases) {
    const auto value = case_to_adopt(source, engine);
    std::vector<CaseResult> runs{run_once(value, engine, o, "first", {})};
    const bool ran = std::any_of(runs[0].engines.begin(), runs[0].engines.end(),
                                 [](const auto& e) { return base_run(e) && base_run(e)->status == Status::ok; });
    if (ran) {
      runs.push_back(run_once(value, engine, o, "repeat", {}));
      const int seeds = has_chance(value, engine) ? o.seeds : 0;
      for (int k = 0; k < seeds; ++k)
        runs.push_back(run_once(value, engine, o, "seed", value.scene.seed + seeds_apart + static_cast<std::uint64_t>(k)));
    }
    AdoptedCase adopted{value.id, source.file, {}};
    for (const auto& e : runs[0].engines)
      if (e.name == engine.name) adopted.rows.push_back(row_of(runs, e, engine, o));
    for (const auto& row : adopted.rows) {
      say(fmt::format(
          "{} {}: {}", value.id, label_of(engine.name, row.preset),
          row.status == Status::ok ? fmt::format("{} gates", row.gates.size()) : fmt::format("{}, {}", row.status, row.reason)));
      for (const auto& note : row.notes) say("  " + note);
    }
    list.push_back(std::move(adopted));
  }
  return list;
}

}  // namespace tripoint
