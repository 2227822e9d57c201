// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/queue/queue.hpp"
#include "validation/results/results.hpp"

/// A run that has ended is published by one rename of its folder: it is there with all its files, or not at
/// all.
namespace tripoint {

/// Id in the row.json of the published run; empty where there is none.
[[nodiscard]] std::string published_id(const std::string& dir, const QueuedJob&);

/// The published run. @throws InputError where it is absent, unreadable or of another job
[[nodiscard]] MadeRun published_run(const std::string& dir, const QueuedJob&);

/// Moves a run's folder to its place, with its row in it.
/// @return false where the job has a result already: the folder stays where it is
/// @throws EngineError where the system does not let it
[[nodiscard]] bool publish(const std::string& dir, const QueuedJob&, const MadeRun&,
                           const std::string& folder, const std::string& worker);

/// Moves the particles that a run has started from to their place, where no run of the same start has brought
/// them before.
/// @param file below the folder `workshop`, as it lies below DIR afterwards
void publish_particles(const std::string& dir, const std::string& file, const std::string& workshop);

/// Takes the row away, so that the run counts as not made.
void withdraw(const std::string& dir, const QueuedJob&);

/// Whether two results of one job agree in all but their cost.
[[nodiscard]] bool same_outcome(RunRow, RunRow);

}  // namespace tripoint
