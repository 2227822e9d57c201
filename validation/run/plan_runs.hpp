// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "scene/defaults.hpp"
#include "tables/settings.hpp"
#include "validation/case/case_words.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/study_axes.hpp"
#include "validation/run/discover.hpp"

/// From a case to the list of its runs and their jobs.
namespace tripoint {

struct Case;
struct InitialState;
struct Job;
struct ReferenceChoice;

/// One run that is to be made.
struct RunPlan {
  JudgedMode mode = JudgedMode::none;
  RunChoice choice;
  std::optional<double> walkers, iterations;
  std::map<StudyAxes, double> levels;  ///< of a study -> level
  bool base = false;
  /// "key=VALUE" of an uncertain input at one end, in place of the case's value; empty = none
  std::string input;
  std::string label;  ///< name of its folder below runs/<case>/<engine>
  std::string group;  ///< runs of one group differ by seed only
};

/// One engine and preset of a case with all its runs.
struct EnginePlan {
  std::string name, preset = default_preset;
  bool required = false;
  Settings settings;
  const EngineEntry* entry = nullptr;  ///< nullptr: not found
  std::vector<RunPlan> runs;
};

struct Selection {
  std::vector<std::string> engines;  ///< --engines; empty = all that the case names
  std::vector<std::string> extra;    ///< names of the engines given by --engine: they join every case
  /// Names that were asked for on the command line: none of them may pass unjudged
  std::vector<std::string> asked;
  std::optional<std::uint64_t> seed;
};

/// Greatest number of runs of one case, those of all its engines, presets and modes together, before equal
/// ones are merged. This is a hundred times the number in a case of ours, and few enough to be planned at
/// once.
inline constexpr std::size_t most_runs = 10'000;

/// Engines that run the case. First are tripoint (required unless the case says otherwise) and, where the
/// reference has states, exact. Then come those that the case lists, the extra ones, and those that
/// TRIPOINT_ENGINE_PATH brings. Modes are tripoint's alone: foreign engines run once. Runs: the case's own
/// resolution, and each level and seed of each study; a run that two studies share is made once. @throws
/// InputError with the place in the case file where it comes to ask for more than most_runs
[[nodiscard]] std::vector<EnginePlan> plan_runs(const Case&, const std::vector<EngineEntry>&,
                                                const Selection&);

/// The scene that a run is made in.
[[nodiscard]] Scene scene_of(const Case&, const RunPlan&);

/// The job of one run: every body of the scene with the mass properties of its particles, output times from 0
/// to the end.
[[nodiscard]] Job make_job(const Case&, const EnginePlan&, const RunPlan&, const Scene&, const InitialState&);

/// Times 0, interval, 2 interval, ..., end [s]; the last is `end` itself.
[[nodiscard]] std::vector<double> output_times(double interval, double end);

/// Key of the particles of a scene: runs of one key share one particles.h5.
[[nodiscard]] std::string sampling_key(const Scene&);

/// Whether a reference describes states (positions, temperatures), so that the engine `exact` can write them.
[[nodiscard]] bool has_states(const ReferenceChoice&);

}  // namespace tripoint
