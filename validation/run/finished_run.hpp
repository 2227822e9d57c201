// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "validation/run/run_one.hpp"

/// Runs that have ended are recorded in outcome-ENGINE-RUN.json beside their particles, under a hash of all
/// that made them. So a suite that was cut need not make them again. An engine writes in its run's folder
/// alone.
namespace tripoint {

/// Hash of a file's bytes; empty where it cannot be read, or is a pipe or a device.
[[nodiscard]] std::string file_hash(const std::string& file);

/// Hash of an engine's program, read once a call: its behaviour may change though it states the same version.
[[nodiscard]] std::string program_hash(const std::string& executable);

/// Hash of the job's text, its particles, the engine's version, build and library, and the environment that
/// it is started with.
[[nodiscard]] std::string run_hash(const RunRequest&, const std::string& job_text);

/// Leaves the record where the run is ok or diverged: an outcome that the same run would have again.
void record_finished(const RunRequest&, const std::string& hash, const ProcessEnd&, const Outcome&);

/// The outcome that is recorded under this hash, with the cost that was paid then; nothing when there is
/// none. Also nothing when the job, the result or the trajectory has changed since, or when the result does
/// not read back to the same status.
[[nodiscard]] std::optional<Outcome> finished_run(const RunRequest&, const std::string& hash);

/// Removes the record of an earlier run. @throws std::filesystem::filesystem_error where it cannot be removed
void forget_finished(const RunRequest&);

/// Paths of the checkpoints in a run's folder, oldest first.
[[nodiscard]] std::vector<std::string> checkpoints_in(const std::string& folder);

/// Removes frames, gauges and checkpoints of all runs below a folder, but for those of these engines. @return
/// number of files
std::size_t remove_answers(const std::string& folder, const std::set<std::string>& kept_engines);

}  // namespace tripoint
