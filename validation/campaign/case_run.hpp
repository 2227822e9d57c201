// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "files/job.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/run/run_one.hpp"

/// The parts of the suite that look at one case.
namespace tripoint {

struct Trajectory;

/// Inputs of a changed run, made in the place of a run whose scene is changed.
struct ChangedRun {
  Job job;
  InitialState initial;
  std::string particles;
  std::shared_ptr<std::string> particles_hash;
};

/// How the reason of a run begins whose engine says that it is deterministic and whose repeat differs.
inline const std::string untrue_flag = "says that it is deterministic, and that is untrue";

/// One run of a case, ready to be made; and what came of it.
struct CaseRun {
  std::size_t engine = 0;  ///< row in CaseRuns::engines
  RunPlan plan;
  Job job;
  std::shared_ptr<const InitialState> initial;
  std::shared_ptr<const ChangedRun> changed;  ///< the run made in its place; empty = itself
  std::string folder, particles;
  std::shared_ptr<std::string> particles_hash;  ///< shared by the runs that start from one file
  RunRow row;
  std::map<std::string, double> ledger;          ///< of the solver's base run
  bool kept = false;                             ///< taken from an earlier call, not made again
  bool taken = false;                            ///< made elsewhere, or earlier in this call
  std::shared_ptr<const Trajectory> trajectory;  ///< kept of base runs, for the comparison of engines
};

struct CaseRuns {
  const Case* value = nullptr;
  std::optional<CaseHashes> hashes;  ///< of its file, before it is run
  std::vector<EnginePlan> engines;
  std::vector<CaseRun> runs;
};

/// Engines of a case and their runs; none is sampled yet.
[[nodiscard]] CaseRuns plan_case(const Case&, const std::vector<EngineEntry>&, const SuiteOptions&);

/// Number of the runs that the plan wants.
[[nodiscard]] std::size_t number_of_runs(const CaseRuns&, const SuiteOptions&);

/// Samples the runs that are wanted and adds them, ready to be made. @throws InputError when a scene cannot
/// be sampled
void add_runs(CaseRuns&, const SuiteOptions&);

/// Plans a case, samples each of its scenes once and writes the particles. @throws InputError when a scene
/// cannot be sampled
[[nodiscard]] CaseRuns prepare_case(const Case&, const std::vector<EngineEntry>&, const SuiteOptions&);

/// Identity of a run of a case among all runs of all cases: its place in the report and all that makes it. 16
/// hex digits.
[[nodiscard]] std::string run_id(const CaseRuns&, const CaseRun&, const SuiteOptions&);

/// A row for a run that could not be made: its knobs, with a status and a reason.
void give_up(CaseRun&, Status status, const std::string& reason, const SuiteOptions&);

/// Makes one run and fills its row; its metrics are evaluated here.
void make_run(const CaseRuns&, CaseRun&, const SuiteOptions&);

/// Puts the runs into rows, compares the engines, adds up the ledger and judges.
[[nodiscard]] CaseResult finish_case(const CaseRuns&, const SuiteOptions&);

/// Differences between the engines' own trajectories, in each metric that compares states; both errors to
/// truth beside it.
[[nodiscard]] std::vector<EquivalenceRow> compare_engines(const CaseRuns&);

/// Change of each energy of the ledger over a run, and their sum, the residual [J].
[[nodiscard]] std::map<std::string, double> ledger_of(const Trajectory&);

}  // namespace tripoint
