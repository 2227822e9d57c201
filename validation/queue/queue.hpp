// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "validation/campaign/suite.hpp"
#include "validation/case/engine_names.hpp"

/// A suite as a folder of jobs that any number of workers share. A job is one run of one engine, as `tripoint
/// validate` makes it.
///
///     suite.json           what was asked, the cases and the jobs
///     todo/ID              a job that waits
///     running/ID.WORKER    a job that a worker has claimed: renamed from todo/ID, so that one worker alone
///     gets it done/ID, failed/ID   how it ended, one line of JSON lost/ID.WORKER       its worker went away
///     with the job, which another took over doubled/ID.WORKER    a second result of a job that was done
///     already runs/...             what the runs left, as `tripoint validate` lays them out, and in each a
///     row.json workers/WORKER.json  a worker that lives touches its file every few seconds; workers/WORKER/
///     is its own workshop
///
/// Every file but those of the workshops comes to be by a rename, so that it is whole or not there. A job
/// goes forward only (todo, running, done).
namespace tripoint {

struct QueuedJob {
  std::string id;  ///< hash of all that makes the run (case_run.hpp: run_id)
  std::string case_id, engine, preset = default_preset;
  std::string label;  ///< of the run in its plan: "corrected", "spacing=0.01-seed2"
  double cost = 0.0;  ///< predicted [CPU s]
};

struct QueuedCase {
  std::string id, file;  ///< path as `suite make` knew it
};

struct Queue {
  /// Working folder of `suite make`: workers and the merge go there, so that every path is the same text for
  /// all
  std::string folder;
  std::string command;  ///< of `suite make`
  CaseFilter filter;    ///< cases that were asked for
  Selection selection;
  std::vector<std::string> engine_words;  ///< given by --engines, as typed
  int threads = 1;                        ///< of each engine process
  double wall_limit = 600.0;              ///< [s]
  std::vector<QueuedCase> cases;
  std::vector<QueuedJob> jobs;
};

/// Names of the folders of states.
namespace state {
inline constexpr const char *todo = "todo", *running = "running", *done = "done", *failed = "failed",
                            *lost = "lost", *doubled = "doubled", *workers = "workers";
}

/// "rigid/ballistic bullet corrected", for people.
[[nodiscard]] std::string name_of(const QueuedJob&);

/// DIR/STATE/NAME.
[[nodiscard]] std::string place(const std::string& dir, const char* state_name, const std::string& name);

/// Where the run of a job lies in its folder of runs: "runs/CASE/ENGINE/LABEL".
[[nodiscard]] std::string run_folder(const QueuedJob&);

[[nodiscard]] std::string queue_text(const Queue&);
/// @throws InputError where DIR/suite.json is absent or is none
[[nodiscard]] Queue read_queue(const std::string& dir);

/// Tries the files of these cases together, before they are read one by one (tables/toml_node.hpp).
void try_cases(const Queue&, const std::set<std::string>& ids);

/// The cases of the suite as they are now, and what every run of it is made with; `out` is left to the
/// caller. @throws InputError for a case that is wrong or gone
[[nodiscard]] std::vector<Case> cases_of(const Queue&);
[[nodiscard]] Case case_of(const Queue&, const std::string& id);
[[nodiscard]] SuiteOptions options_of(const Queue&);

/// A file that appears whole or not at all, without waiting for the disk: a file lost with the machine's
/// power is made again.
/// @throws EngineError
void write_by_rename(const std::string& path, const std::string& text, const std::string& own_name);

}  // namespace tripoint
