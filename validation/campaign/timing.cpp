// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/timing_pairs.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

RunRow* row_of(CaseResult& result, const EnginePlan& engine, const RunPlan& plan) {
  const std::string label = run_folder_name(engine.preset, plan.label);
  for (auto& e : result.engines)
    if (e.name == engine.name && e.preset == engine.preset)
      for (auto& r : e.runs)
        if (fs::path(r.folder).filename() == label) return &r;
  return nullptr;
}

/// A run that is timed; the base run of each engine is so twice a round, as one and as the other of a pair.
struct Timed {
  CaseRun* run = nullptr;
  RunRow* row = nullptr;
  enum class Part { single, first, second } part = Part::single;
};

std::vector<Timed> timed_runs(CaseRuns& all, CaseResult& result) {
  std::vector<Timed> list, twins;
  std::vector<std::size_t> paired;
  for (auto& run : all.runs) {
    auto* row = row_of(result, all.engines[run.engine], run.plan);
    const bool is_paired =
        run.plan.base && std::find(paired.begin(), paired.end(), run.engine) == paired.end();
    list.push_back({&run, row, is_paired ? Timed::Part::first : Timed::Part::single});
    if (!is_paired) continue;
    paired.push_back(run.engine);
    twins.push_back({&run, row, Timed::Part::second});
  }
  list.insert(list.end(), twins.begin(), twins.end());
  return list;
}

}  // namespace

void time_case(const Case& value, const std::vector<EngineEntry>& found, int rounds,
               const SuiteOptions& options, CaseResult& result) {
  auto alone = options;
  alone.out = (fs::path(options.out) / "timing").string();
  alone.jobs = 1;
  alone.resume = false;
  alone.count_below = 0.0;
  alone.wanted = [&](const EnginePlan& engine, const RunPlan& plan) {
    const auto* row = is_exact(engine.name) || !plan.input.empty() ? nullptr : row_of(result, engine, plan);
    return row && row->status == Status::ok;
  };
  auto all = prepare_case(value, found, alone);
  auto runs = timed_runs(all, result);
  // Engine -> the same run, twice a round
  std::map<std::size_t, std::vector<std::pair<double, double>>> twice;
  for (int round = 0; round < rounds && !interrupted(); ++round) {
    if (options.say)
      options.say(
          fmt::format("timing {}: round {} of {}, {} runs", value.id, round + 1, rounds, runs.size()));
    std::map<std::size_t, std::pair<double, double>> of_round;
    for (auto& timed : runs) {
      const std::string bits = timed.row->state_hash;
      make_run(all, *timed.run, alone);
      const bool same =
          timed.run->row.status == Status::ok &&
          (timed.run->row.state_hash == bits || !all.engines[timed.run->engine].entry->deterministic);
      const double seconds = same ? timed.run->row.cost.cpu_s : not_a_number;
      if (timed.part != Timed::Part::second) timed.row->cost.repeats.push_back(seconds);
      if (timed.part == Timed::Part::first) of_round[timed.run->engine].first = seconds;
      if (timed.part == Timed::Part::second) of_round[timed.run->engine].second = seconds;
    }
    for (const auto& [engine, seconds] : of_round) twice[engine].push_back(seconds);
    std::reverse(runs.begin(), runs.end());
  }
  for (const auto& timed : runs)
    if (std::any_of(timed.row->cost.repeats.begin(), timed.row->cost.repeats.end(),
                    [](double s) { return !(s > 0.0); }))
      timed.row->cost.repeats.clear();
  result.timing_rounds = rounds;
  result.timing_floor = not_a_number;
  for (const auto& [engine, pairs] : twice)
    if (const double floor = noise_floor(pairs); !(result.timing_floor >= floor)) result.timing_floor = floor;
  fs::remove_all(alone.out);
}

}  // namespace tripoint
