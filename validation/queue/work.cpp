// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/work.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/errors.hpp"
#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/queue/published.hpp"
#include "validation/queue/standing.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr int most_losses = 3;  // of workers by one job
constexpr auto pause = std::chrono::milliseconds(200), longest_pause = std::chrono::milliseconds(5000);

/// Data that the workers of one process share.
class Crew {
 public:
  Crew(std::string dir, const Queue& queue, const std::vector<EngineEntry>& engines,
       const WorkOptions& options)
      : dir_(std::move(dir)), queue_(queue), engines_(engines), options_(options) {}

  WorkDone run() {
    std::set<std::string> ids;
    for (const auto row : options_.rows) ids.insert(queue_.jobs[row].case_id);
    try_cases(queue_, ids);
    std::vector<std::thread> threads;
    for (int n = 0; n < options_.jobs; ++n)
      threads.emplace_back([this, n] {
        try {
          work(n);
        } catch (...) {
          const std::lock_guard lock(mutex_);
          if (!failure_) failure_ = std::current_exception();
          stops_ = true;
        }
      });
    for (auto& t : threads) t.join();
    if (failure_) std::rethrow_exception(failure_);
    const auto standing = look(dir_, queue_);
    for (const auto row : options_.rows)
      if (!ended(standing.jobs[row].stand)) ++done_.held_by_others;
    return done_;
  }

 private:
  static bool ended(Stand stand) { return stand == Stand::done || stand == Stand::failed; }
  bool stopped() const { return stops_ || interrupted(); }

  void work(int number) {
    const Worker worker(dir_, number);
    auto wait = pause;
    std::set<std::string> nowhere;
    while (!stopped()) {
      const auto standing = look(dir_, queue_);
      put_back(worker, standing, nowhere);
      bool all_ended = true, got_one = false;
      for (const auto row : options_.rows) {
        if (stopped()) return;
        const auto& stand = standing.jobs[row];
        if (ended(stand.stand)) continue;
        all_ended = false;
        if (take(worker, queue_.jobs[row], stand, standing)) got_one = true;
      }
      if (all_ended) return;
      if (got_one) {
        wait = pause;
        continue;
      }
      if (!options_.waits) return;
      say_waiting(standing);
      std::this_thread::sleep_for(wait);
      wait = std::min(wait * 2, std::chrono::milliseconds(longest_pause));
    }
  }

  /// Jobs whose file somebody took away wait again. One look may miss a job that just goes back; two in a row
  /// do not.
  void put_back(const Worker& worker, const Standing& standing, std::set<std::string>& nowhere) {
    std::set<std::string> now;
    for (const auto row : options_.rows) {
      const auto& stand = standing.jobs[row];
      const auto& job = queue_.jobs[row];
      if (stand.stand != Stand::lost || !stand.worker.empty()) continue;
      now.insert(job.id);
      if (nowhere.count(job.id) == 0) continue;
      say(fmt::format("lost: {} ({}) is in no folder of the suite: put back", name_of(job), job.id));
      write_by_rename(place(dir_, state::todo, job.id), "", worker.name());
    }
    nowhere = std::move(now);
  }

  /// @return whether the job was ours to do
  bool take(const Worker& worker, const QueuedJob& job, const JobStand& stand, const Standing& standing) {
    int losses = 0;
    if (const auto at = standing.losses.find(job.id); at != standing.losses.end()) losses = at->second;
    if (stand.stand == Stand::waiting) {
      if (!worker.claim(job.id)) return false;
    } else if (stand.stand == Stand::lost && !stand.worker.empty()) {
      if (!worker.take_over(job.id, stand.worker)) return false;
      ++losses;
      say(fmt::format("lost: {} ({}) was held by {}, which is gone: taken over", name_of(job), job.id,
                      stand.worker));
      count(&WorkDone::taken_over);
    } else {
      return false;
    }
    try {
      make(worker, job, losses);
    } catch (...) {
      worker.release(job.id);
      throw;
    }
    return true;
  }

  void make(const Worker& worker, const QueuedJob& job, int losses) {
    // Its worker was lost between the run and its note
    if (published_id(dir_, job) == job.id) return note_end(worker, job, published_run(dir_, job).row);
    auto options = options_of(queue_);
    options.out = worker.workshop();
    options.wanted = [&](const EnginePlan& engine, const RunPlan& run) {
      return engine.name == job.engine && engine.preset == job.preset && run.label == job.label;
    };
    auto all = prepared(job, options);
    auto& run = all.runs.front();
    if (losses >= most_losses)
      give_up(run, Status::killed, fmt::format("its worker was lost {} times", losses), options);
    else
      make_run(all, run, options);
    if (interrupted()) return worker.release(job.id);
    // Checked after the run
    if (run.row.status == Status::ok) publish_particles(dir_, run.particles, options.out);
    if (publish(dir_, job, {run.row, run.ledger}, run.folder, worker.name()))
      return note_end(worker, job, run.row);
    const auto first = published_run(dir_, job).row;
    const bool same = same_outcome(first, run.row);
    worker.note_double(job.id, nlohmann::json{{"same", same}}.dump());
    say(fmt::format("doubled: {} ({}) had a result already; ours {}, and is dropped", name_of(job), job.id,
                    same ? "is the same" : "DIFFERS from it"));
    note_end(worker, job, first);
  }

  /// The one run of a job, sampled and ready. A case is read and planned once a process; one thread at a time
  /// samples.
  CaseRuns prepared(const QueuedJob& job, const SuiteOptions& options) {
    const std::lock_guard lock(planning_);
    auto& plan = plans_[job.case_id];
    if (!plan) {
      cases_.push_back(case_of(queue_, job.case_id));
      plan = std::make_unique<CaseRuns>(plan_case(cases_.back(), engines_, options));
    }
    auto all = *plan;
    add_runs(all, options);
    if (all.runs.size() != 1 || run_id(all, all.runs.front(), options) != job.id)
      throw InputError(
          fmt::format("{} ({}): is not the run that the suite was made of: the case, the engine or this "
                      "program is another. "
                      "tripoint suite make again keeps every job that is still the same",
                      name_of(job), job.id));
    return all;
  }

  void note_end(const Worker& worker, const QueuedJob& job, const RunRow& row) {
    const bool failed = crashed(row);
    const nlohmann::ordered_json note{{"status", row.status},    {"reason", row.reason},
                                      {"cpu_s", row.cost.cpu_s}, {"wall_s", row.cost.wall_s},
                                      {"cost_s", job.cost},      {"worker", worker.name()}};
    worker.finish(job.id, note.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
                  failed);
    count(&WorkDone::made);
    if (failed) count(&WorkDone::failed);
    say(fmt::format("{} {}: {}{} ({:.2f} CPU s)", job.id, name_of(job), row.status,
                    row.reason.empty() ? "" : ", " + row.reason, row.cost.cpu_s));
  }

  void say_waiting(const Standing& standing) {
    if (says_it_waits_.exchange(true)) return;
    std::size_t held = 0;
    for (const auto row : options_.rows) held += ended(standing.jobs[row].stand) ? 0 : 1;
    say(fmt::format("waiting for {} jobs that other workers hold; Ctrl-C leaves them to those", held));
  }

  void count(std::size_t WorkDone::*what) {
    const std::lock_guard lock(mutex_);
    ++(done_.*what);
  }
  void say(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (options_.say) options_.say(line);
  }

  const std::string dir_;
  const Queue& queue_;
  const std::vector<EngineEntry>& engines_;
  const WorkOptions& options_;
  std::mutex mutex_, planning_;
  std::deque<Case> cases_;  ///< that plans point to: a deque leaves them where they are
  std::map<std::string, std::unique_ptr<CaseRuns>> plans_;
  std::exception_ptr failure_;
  std::atomic<bool> stops_{false}, says_it_waits_{false};
  WorkDone done_;
};

}  // namespace

WorkDone work(const std::string& dir, const Queue& queue, const std::vector<EngineEntry>& engines,
              const WorkOptions& options) {
  return Crew(dir, queue, engines, options).run();
}

}  // namespace tripoint
