// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "validation/queue/queue.hpp"
#include "validation/queue/worker.hpp"

namespace tripoint {

enum class Stand { waiting, running, lost, done, failed };

struct JobStand {
  Stand stand = Stand::lost;
  std::string worker;  ///< that holds it, or held it; empty = none: its file was taken away
};

/// Where every job stands, by looking into five folders once, whatever the number of jobs.
struct Standing {
  std::vector<JobStand> jobs;                 ///< as in Queue::jobs
  std::map<std::string, WorkerSign> workers;  ///< that gave a sign, or hold a job
  std::map<std::string, int> losses;          ///< by id: how often its worker was lost
  std::vector<std::string> doubled;           ///< ID.WORKER of each second result

  [[nodiscard]] std::size_t count(Stand) const;
};

/// @throws InputError where DIR lacks a folder of states
[[nodiscard]] Standing look(const std::string& dir, const Queue&);

}  // namespace tripoint
