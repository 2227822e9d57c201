// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "program/cli/predict_runs.hpp"

namespace tripoint {

/// What is to be run for a prediction.
struct TurnsWanted {
  std::vector<int> ranks;           ///< that are predicted
  std::vector<int> measure;         ///< that are also run
  std::vector<std::string> larger;  ///< keys that make the scene of weak scaling; empty: it is finer
  bool weak = false;
  int repeats = 1;        ///< at least
  int most_repeats = 1;   ///< while the best times still fall
  double patience = 0.0;  ///< [s] in all, for cores that are slow before a run
  int cores = 1;          ///< up to which runs go at once
  bool quiet = false;
};

/// How quiet the machine was, and whether the repeats were enough.
struct HowRunsWent {
  int repeats = 0;                ///< of each run
  bool settled = false;           ///< the last of them lowered no best time by much
  int looks = 0, slow_looks = 0;  ///< at the cores, before runs and while waiting
  double waited = 0.0;            ///< [s] for cores that were slow
};

/// All timed runs of a prediction. They take turns: what slows the machine for a while comes upon all alike,
/// and a prediction is made of runs of the same minutes that it is held against. Before each run the cores
/// are looked at, and a bounded time is waited for those that are slow; repeats go on until they no longer
/// lower the best times.
struct RunsInTurns {
  /// The case, coarser, with a wider support: the last tells a pair's cost from a particle's
  std::vector<Prepared> one_rank;
  std::vector<Timed> one_rank_timed;
  std::map<int, Timed> at_once;    ///< the case on one rank, by how many such runs went at once
  std::map<int, Timed> strong;     ///< the case, by ranks above one
  std::map<int, Prepared> larger;  ///< as many particles a rank, by ranks
  std::map<int, Timed> weak;       ///< their runs, where they are measured
  HowRunsWent went;

  [[nodiscard]] const Timed& alone() const { return one_rank_timed.front(); }
  [[nodiscard]] const Timed& on(int ranks) const { return ranks == 1 ? alone() : strong.at(ranks); }
};

/// @param notes runs that could not be made   @throws EngineError where the case itself cannot be run
[[nodiscard]] RunsInTurns run_in_turns(PredictRuns&, const TurnsWanted&, std::vector<std::string>& notes);

}  // namespace tripoint
