// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

struct InitialState;
struct Job;
struct MetricChoice;
struct Snapshot;
struct Trajectory;

using Frames = std::vector<const Snapshot*>;

/// The run's frames at the job's times, one for each; `problem` when one is missing or a frame does not hold
/// the job's particles.
struct JobFrames {
  Frames list;
  std::string problem;
};
[[nodiscard]] JobFrames frames_of_job(const Job&, const InitialState&, const Trajectory&);

/// Frames that a metric looks at. For a norm in space: by `at` ("end", "all" or a time in s). For one in
/// time: by `window`.
/// @throws InputError when `at` is none of these or no output time of the job
[[nodiscard]] Frames chosen_frames(const MetricChoice&, const Job&, const Frames&);
[[nodiscard]] Frames frames_in_window(const MetricChoice&, const Job&, const Frames&);

/// Output times agree to 1e-9 of the end [s].
[[nodiscard]] double time_tolerance(const Job&);

}  // namespace tripoint
