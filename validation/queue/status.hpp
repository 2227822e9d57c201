// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/queue/standing.hpp"

/// Output of `tripoint status`.
namespace tripoint {

struct QueueStatus {
  Standing standing;
  int busy_workers = 0;       ///< that live and hold a job
  double rest = 0.0;          ///< predicted cost of unfinished jobs; half of it for running ones [CPU s]
  double speed = 1.0;         ///< wall seconds that a predicted second took, over a sample of finished jobs
  std::size_t sampled = 0;    ///< jobs in that sample
  double seconds_left = 0.0;  ///< rest * speed / workers, one worker where none is at it [s]
};

/// @param sample how many results are opened to learn the speed; their number is bounded, so that a status
/// costs the same for many jobs
[[nodiscard]] QueueStatus status_of(const std::string& dir, const Queue&, std::size_t sample = 200);

[[nodiscard]] std::string status_text(const std::string& dir, const Queue&, const QueueStatus&);
[[nodiscard]] std::string status_json(const std::string& dir, const Queue&, const QueueStatus&);

}  // namespace tripoint
