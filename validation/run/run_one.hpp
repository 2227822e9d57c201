// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "files/result.hpp"
#include "validation/results/results.hpp"
#include "validation/run/plan_runs.hpp"
#include "validation/run/process.hpp"

namespace tripoint {

struct MetricChoice;
struct Trajectory;

/// One job for one engine executable.
struct RunRequest {
  const EngineEntry* engine = nullptr;
  const Job* job = nullptr;
  const InitialState* initial = nullptr;
  std::string folder;     ///< results of an earlier run in it are removed first: they are never judged
  std::string particles;  ///< path of particles.h5
  /// file_hash of it as it was written last; no engine may change the start of all engines
  std::shared_ptr<std::string> particles_hash;
  double wall_limit = 600.0;  ///< [s]
  std::map<std::string, std::string> environment;
  std::function<void(double)> progress;
  /// Of engines that tell more than how far they are (process.hpp)
  std::function<void(const std::string&)> status;
  /// [CPU s] instructions of a shorter run are counted by callgrind where the processor counts none; 0 =
  /// never
  double count_below = 0.0;
  /// Called before an engine of somebody else is, where no earlier outcome is kept
  std::function<void()> before_third_party;
  /// Takes the outcome of an earlier run in the folder, if it was of this very job and engine
  bool keep_finished = false;
};

struct Outcome {
  Status status = Status::ok;
  std::string reason;     ///< as in results.json
  bool explained = true;  ///< of a refusal: the reason is the engine's own
  bool comparable = true;
  bool kept = false;                             ///< of an earlier run, not made again
  Result result;                                 ///< of the engine, where there is one
  std::shared_ptr<const Trajectory> trajectory;  ///< where status is ok
  Cost cost;
};

/// Hash that tells this run from any other: its job, its particles, and the engine that makes it
/// (finished_run.hpp: run_hash).
[[nodiscard]] std::string hash_of(const RunRequest&);

/// Writes the job, asks --check, runs, and reads back; a fault of the engine becomes a status with its
/// reason, never an exception.
[[nodiscard]] Outcome run_one(const RunRequest&);

/// Writes the job and asks --check: status ok where the engine can run it, else refused, error, timeout or
/// killed with the reason.
[[nodiscard]] Outcome ask(const RunRequest&);

/// Reads result and trajectory from the folder of a run that has ended.
[[nodiscard]] Outcome read_back(const RunRequest&, const ProcessEnd&);

/// Compares the values that the engine holds with its input: gravity, masses, inertia, damping.
/// @return empty when it is the same scene, else what differs, by name
[[nodiscard]] std::string audit_scene(const Job&, const Readback&);

/// One metric of one run. A norm that compares a run with its own start ("drift") does without the case's
/// reference where that does not fit the scene. @throws InputError where the reference or the metric's words
/// do not fit
[[nodiscard]] MetricValue metric_of(const Case&, const MetricChoice&, const Job&, const InitialState&,
                                    const Trajectory&);

/// The metrics of a case for one run that is ok, by name.
[[nodiscard]] std::map<std::string, MetricValue> evaluate_all(const Case&, const Job&, const InitialState&,
                                                              const Trajectory&);

}  // namespace tripoint
