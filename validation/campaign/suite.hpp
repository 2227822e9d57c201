// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "validation/results/results.hpp"
#include "validation/run/plan_runs.hpp"

/// Runs cases on engines and judges them.
namespace tripoint {

struct Case;
struct InitialState;
struct InvarianceChange;

/// A tag, name or profile that no case has: nothing was asked to run.
class NothingSelected : public InputError {
 public:
  using InputError::InputError;
};

struct CaseFilter {
  /// Files, folders or case ids; empty = all cases beside the program
  std::vector<std::string> what;
  /// Empty = every profile; files and ids are taken whatever their profile
  std::string profile;
  std::string tag;                               ///< empty = any
  std::string substring;                         ///< of the id; empty = any
  std::optional<std::vector<std::string>> only;  ///< only these ids; unset = any
  /// Takes the cases shard, shard + shards, ... of the list by id
  int shard = 1, shards = 1;
};

/// Reads the cases, in order of their ids. @throws InputError for a file that is wrong, an id used twice;
/// NothingSelected for a filter that nothing matches
[[nodiscard]] std::vector<Case> select_cases(const CaseFilter&);

struct CaseRuns;
struct CaseRun;

/// What is kept of a run besides its files.
struct MadeRun {
  RunRow row;
  std::map<std::string, double> ledger;  ///< of the solver's base run [J], by term
};

struct SuiteOptions {
  Selection selection;
  std::string out = "report";  ///< runs go below out/runs
  int jobs = 1;                ///< engine processes at a time
  int threads = 1;             ///< of each engine process
  /// Runs of an earlier call that have ended, of the same job and engine, are kept
  bool resume = false;
  /// [CPU s] instructions of shorter runs are counted by callgrind where the processor counts none; 0 = never
  double count_below = 0.0;
  /// [s] for a run whose case says nothing else (engine setting wall_limit)
  double wall_limit = 600.0;
  std::map<std::string, std::string> environment;  ///< for the engines
  /// Every scene is run changed, and its frames are taken back before they are judged
  const InvarianceChange* change = nullptr;
  /// Which runs of the plan are made; empty = all.
  std::function<bool(const EnginePlan&, const RunPlan&)> wanted;
  bool plans_alone = false;  ///< no run will be made: nothing is written
  bool are_all_made = true;  ///< `made` knows every run of the plan
  /// A run that was made elsewhere, in the place of making it; its folder lies below `out` already. Empty =
  /// runs are made here. Nothing = that run is made here after all.
  std::function<std::optional<MadeRun>(const CaseRuns&, const CaseRun&)> made;
  /// Each run as soon as it is made, from any thread
  std::function<void(const CaseRuns&, const CaseRun&)> on_run;
  /// Called before an engine of somebody else runs, where no earlier outcome is kept
  std::function<void()> before_third_party;
  /// Starts that were let down into equilibrium, by file: that takes minutes. Unset = none is kept.
  std::shared_ptr<std::map<std::string, std::shared_ptr<const InitialState>>> settled;
  std::function<void(const std::string&)> say;     ///< progress, one line a call, from any thread
  std::function<void(const CaseResult&)> on_case;  ///< each case as soon as it and those before it are judged
};

/// The verdicts of all cases, in their order; judged. Stopped by Ctrl-C, it returns the finished cases.
[[nodiscard]] Results run_suite(const std::vector<Case>&, const std::vector<EngineEntry>&,
                                const SuiteOptions&);

/// Path as people type it: below the working folder if it lies there, with links resolved.
[[nodiscard]] std::string shown_path(const std::string& path);

}  // namespace tripoint
