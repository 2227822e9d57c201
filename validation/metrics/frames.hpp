// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/metrics/metric.hpp"

namespace tripoint {

using Frames = std::vector<const Snapshot*>;

/// The run's frames at the job's times, one for each; `problem` when one is missing or a frame does not hold the job's particles.
struct JobFrames {
  Frames list;
  std::string problem;
};
[[nodiscard]] JobFrames frames_of_job(const Job&, const InitialState&, const Trajectory&);

/// Those that a metric looks at: by `at` for a norm in space ("end", "all" or a time in s), by `window` for one in time.
/// @throws InputError when `at` is none of these or no output time of the job
[[nodiscard]] Frames chosen_frames(const MetricChoice&, const Job&, const Frames&);
[[nodiscard]] Frames frames_in_window(const MetricChoice&, const Job&, const Frames&);

/// Output times agree to 1e-9 of the end [s].
[[nodiscard]] double time_tolerance(const Job&);

}  // namespace tripoint
