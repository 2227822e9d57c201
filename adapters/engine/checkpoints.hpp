// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "core/checkpoint.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"

/// Checkpoints of a job: data of the run beside the engine's own state, when they are due, and where they
/// lie.
namespace tripoint {

/// Data that must be the same when a checkpoint is resumed: the scene, its particles and the build. Threads,
/// paths, the end and the interval of checkpoints may change.
[[nodiscard]] std::vector<std::string> identity_of(const Job&, const InitialState&, const std::string& build);

/// The run as far as its frames go: they are in trajectory.h5 beside the checkpoint.
struct Progress {
  std::size_t frames = 0;  ///< written so far; the run was on its way to times[frames]
  FramesHash hash;         ///< of them
};

/// Writes checkpoint-STEP.h5 into the job's folder: each time that simulated time passes a multiple of the
/// job's setting checkpoint_interval [s], and when asked to. The last two are kept.
class Checkpoints {
 public:
  /// @throws InputError when the interval is no positive number
  Checkpoints(const Job&, std::vector<std::string> identity);
  [[nodiscard]] const std::vector<std::string>& identity() const { return identity_; }
  /// Counts on from the checkpoint of the job. @return its time [s]
  double go_on_from(const Checkpoint&);
  /// @return true once for each multiple of the interval that `time` has passed
  [[nodiscard]] bool due(double time);
  /// Adds the data of the run, writes the file durably, and removes files older than the one before.
  /// @return its path   @throws EngineError
  std::string write(Checkpoint, double time, long step, const Progress&);
  /// Name of the last file written, empty = none.
  [[nodiscard]] std::string last() const;

 private:
  [[nodiscard]] long multiples(double time) const;

  const Job& job_;
  std::vector<std::string> identity_;
  double interval_ = 0.0;
  long passed_ = 0;
  std::deque<std::string> kept_;
};

/// Reads the checkpoint that the job resumes from. @throws InputError: torn, of another scene, of another
/// build, or on its way to a time that is no output time of this job
[[nodiscard]] Checkpoint open_checkpoint(const Job&, const std::vector<std::string>& identity);

/// The frames that the cut run had written, from trajectory.h5 beside the checkpoint.
/// @throws InputError when they are not those that it had written
[[nodiscard]] std::vector<Snapshot> earlier_frames(const Job&, const Checkpoint&);

}  // namespace tripoint
