// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/queue/queue.hpp"

namespace tripoint {

struct WorkOptions {
  int jobs = 1;       ///< workers in this process, each with one engine process at a time
  bool waits = true;  ///< for jobs that others hold, until they are done, or lost and taken over
  /// Of Queue::jobs: those that are to be done here, in the order in which they are begun
  std::vector<std::size_t> rows;
  std::function<void(const std::string&)> say;  ///< from any thread
};

struct WorkDone {
  std::size_t made = 0, failed = 0;  ///< by these workers
  std::size_t taken_over = 0;        ///< of them, from workers that were lost
  std::size_t held_by_others = 0;    ///< not finished when they left
};

/// Takes jobs until all of `rows` are finished, or Ctrl-C: then the jobs that it holds go back to those that
/// wait. A job that has cost three workers their lives is given up. It becomes a killed run, so that it does
/// not take every worker with it.
/// @throws InputError where a run is no longer the one that the suite was made of
[[nodiscard]] WorkDone work(const std::string& dir, const Queue&, const std::vector<EngineEntry>&,
                            const WorkOptions&);

}  // namespace tripoint
