// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "validation/mutation/selftest.hpp"
#include "validation/run/plan_runs.hpp"

/// False alarms: runs that depend on a seed are made again with other seeds, and no gate may turn.
namespace tripoint {

/// One gate of one engine's runs, over the seeds.
struct SeedOutcome {
  std::string case_id, engine, metric, allows;
  JudgedMode mode = JudgedMode::none;
  std::optional<double> level;
  std::vector<double> values;                            ///< one a seed
  std::vector<std::uint64_t> alarms;                     ///< seeds at which the gate was not green
  double mean = not_a_number, deviation = not_a_number;  ///< of the values; standard deviation over seeds
  double distance = not_a_number;  ///< from the mean to the nearest edge of the gate, in standard deviations
  Gate gate;                       ///< its limits, and where they are written
};

struct SeedsOutcome {
  std::deque<SeedOutcome> gates;             ///< a deque: those that are there stay where they are
  std::vector<std::string> cases, problems;  ///< cases that chance has a hand in; runs that were not ok
  int seeds = 0, exit_code = 0;              ///< 0 or 5
};

/// Whether another seed makes another run: jittered particles, walkers, or an engine that says that it is not
/// deterministic.
[[nodiscard]] bool depends_on_seed(const Case&, const EnginePlan&, const RunPlan&);

/// Runs the engines whose results depend on a seed with `count` seeds from `first` on (never the cases' own).
/// Collects every gate that is judged.
/// @throws InputError where no case depends on a seed
[[nodiscard]] SeedsOutcome try_seeds(const std::vector<Case>&, const std::vector<EngineEntry>&, int count,
                                     const SelftestOptions&);

/// Adds the gates of a case that was run with one seed.
void add_seed(const CaseResult&, std::uint64_t seed, SeedsOutcome&);
/// Mean, deviation, distance and exit code, when all seeds are in.
void settle(SeedsOutcome&);

[[nodiscard]] std::string seeds_table(const SeedsOutcome&);
[[nodiscard]] std::string seeds_json(const SeedsOutcome&);

}  // namespace tripoint
