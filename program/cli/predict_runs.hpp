// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "program/predict/cost.hpp"
#include "program/predict/part_times.hpp"
#include "scene/initial_state.hpp"
#include "validation/case/case.hpp"
#include "validation/run/plan_runs.hpp"
#include "validation/run/run_one.hpp"

/// The runs that `tripoint predict` makes of a case on the engine tripoint-mpi.
namespace tripoint {

/// A case at one resolution, ready for the engine.
struct Prepared {
  std::string label;  ///< of its folder: case, coarse, wide, weak-4
  Case value;
  EnginePlan plan;
  Scene scene;
  InitialState initial;
  predict::Cloud cloud;
  double end = 0.0;   ///< of the timed runs [s]
  double step = 0.0;  ///< of time, that they make [s]
  /// a particle of the whole scene as each rank has it at the start: handed over, and the solver's fields
  double weight_bytes = 0;
};

/// Repeats of one run.
struct Timed {
  int ranks = 1;
  long steps = 0;
  std::vector<double> wall;  ///< [s] a step, of each repeat
  /// Over all repeats: cores may be slow for a while, and others than those of another run
  predict::BestTimes best;
  double bytes = 0.0, pairs = 0.0;  ///< of rank 0, pairs a pass as the engine counts them
  double own = 0.0, copies = 0.0;   ///< of rank 0, as it starts
  predict::Traffic traffic;
};

class PredictRuns {
 public:
  /// @throws EngineError where the engine is not there or not available
  PredictRuns(std::string file, std::vector<std::string> set, std::string folder, double seconds, bool quiet);

  /// @param more overrides beside those of the command line   @throws InputError, EngineError for a case that
  /// the engine cannot run, with its reason
  [[nodiscard]] Prepared prepare(const std::string& label, const std::vector<std::string>& more);
  /// Finds how long the timed runs are, by a run of one step on one rank. @param most time that they cover,
  /// but for ten steps [s]: runs that are compared cover the same, in which as many lists a step are made
  void choose_end(Prepared&, double most = std::numeric_limits<double>::infinity());
  /// The timed runs make as many steps as those of another scene, whatever they cost: so they make as many
  /// lists a step, too.
  void choose_end_as(Prepared&, const Prepared& other);
  /// One more repeat. @throws EngineError with the reason of a run that did not end well
  void time(const Prepared&, Timed&);
  /// As many runs on one rank at once, apart from each other: what the cores do where all have work. Of each
  /// part the slowest run counts. They do not count as runs of one rank alone: of more runs the best is
  /// better, and the comparison would not be fair.
  /// @throws EngineError as time()
  void time_at_once(const Prepared&, int count, Timed&);
  /// `--probe` of the engine, two ranks. @throws EngineError
  [[nodiscard]] predict::Machine probe() const;

 private:
  /// One step on one rank, which finds the step of the timed runs and the reach of copies. @return [s] of CPU
  double pilot(Prepared&);
  void say_steps(const Prepared&) const;
  [[nodiscard]] std::string folder_of(const Prepared&, const std::string& which) const;
  [[nodiscard]] Outcome run(const Prepared&, int ranks, double end, const std::string& folder);

  std::string file_;
  std::vector<std::string> set_;
  std::string folder_;
  double seconds_;
  bool quiet_;
  std::vector<EngineEntry> engines_;
};

}  // namespace tripoint
