// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "validation/queue/queue.hpp"

namespace tripoint {

struct QueueMade {
  Queue queue;
  std::size_t kept = 0;      ///< jobs that have a result already
  std::size_t measured = 0;  ///< jobs whose cost an earlier report measured; the others' is predicted
};

/// Plans every run of the cases, and lays out DIR. A folder that is there already keeps its finished jobs. A
/// job whose case, engine, version, level and seed are unchanged has the id that it had. A job that no longer
/// belongs to the suite is no longer to be done; its results stay.
/// @param wanted the question; its cases and jobs are filled in here
/// @param costs CPU seconds by run folder (measured_costs)
/// @throws InputError where a case is wrong, or where no engine that is here runs any of them
[[nodiscard]] QueueMade make_queue(const std::string& dir, Queue wanted, const std::vector<Case>&,
                                   const std::vector<EngineEntry>&,
                                   const std::map<std::string, double>& costs);

/// Puts failed jobs back to those that wait; no ids = all of them. @return how many. @throws InputError for
/// an id that is not failed
std::size_t retry_failed(const std::string& dir, const Queue&, const std::vector<std::string>& ids);

}  // namespace tripoint
