// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/suite.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "validation/harness/case_run.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/process.hpp"

namespace tripoint {
namespace {

/// Cases are prepared in order by one thread while others make their runs; results keep the order of the cases whatever ends first.
class Suite {
 public:
  Suite(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines, const SuiteOptions& options)
      : cases_(cases), engines_(engines), options_(options), slots_(cases.size()) {}

  std::vector<CaseResult> run() {
    std::vector<std::thread> workers;
    for (int i = 0; i < std::max(1, options_.jobs); ++i) workers.emplace_back([this] { work(); });
    std::exception_ptr failure;
    try {
      for (std::size_t c = 0; c < cases_.size() && !interrupted() && !given_up_; ++c) prepare(c);
    } catch (...) {
      if (!interrupted()) failure = std::current_exception();  // what is stopped half-way is no failure: the complete cases are reported
      given_up_ = true;
    }
    {
      const std::lock_guard lock(mutex_);
      all_queued_ = true;
    }
    changed_.notify_all();
    for (auto& w : workers) w.join();
    if (failure) std::rethrow_exception(failure);
    if (failure_) std::rethrow_exception(failure_);
    std::vector<CaseResult> results;
    for (auto& s : slots_)
      if (s.result) results.push_back(std::move(*s.result));
    return results;
  }

 private:
  struct Slot {
    std::unique_ptr<CaseRuns> runs;
    std::size_t left = 0;
    std::optional<CaseResult> result;
  };
  struct Work {
    std::size_t slot, run;
  };

  void prepare(std::size_t c) {
    auto runs = std::make_unique<CaseRuns>(prepare_case(cases_[c], engines_, options_));
    const std::size_t n = runs->runs.size();
    {
      const std::lock_guard lock(mutex_);
      slots_[c].runs = std::move(runs), slots_[c].left = n;
      for (std::size_t r = 0; r < n; ++r) queue_.push_back({c, r});
      queued_ += n;
    }
    changed_.notify_all();
    if (n == 0) finish(c);
  }

  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !queue_.empty() || all_queued_; });
      if (queue_.empty()) return;
      const auto next = queue_.front();
      queue_.pop_front();
      lock.unlock();
      if (given_up_ || interrupted()) continue;
      try {
        make(next);
      } catch (...) {
        lock.lock();
        if (!failure_) failure_ = std::current_exception();
        given_up_ = true;
      }
    }
  }

  void make(const Work& next) {
    auto& slot = slots_[next.slot];
    make_run(*slot.runs, slot.runs->runs[next.run], options_);
    say_run(*slot.runs, slot.runs->runs[next.run]);
    std::unique_lock lock(mutex_);
    const bool last = --slot.left == 0;
    lock.unlock();
    if (last && !interrupted()) finish(next.slot);
  }

  void finish(std::size_t c) {
    auto result = finish_case(*slots_[c].runs, options_);
    const std::lock_guard lock(mutex_);
    slots_[c].result = std::move(result);
    slots_[c].runs.reset();
    for (; announced_ < slots_.size() && slots_[announced_].result; ++announced_)
      if (options_.on_case) options_.on_case(*slots_[announced_].result);
  }

  void say_run(const CaseRuns& all, const CaseRun& run) {
    if (!options_.say) return;
    const std::lock_guard lock(mutex_);
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    ++done_;
    const double left = elapsed / static_cast<double>(done_) * static_cast<double>(queued_ - done_);
    options_.say(fmt::format("[{:3}/{}{}  {:.0f} s, about {:.0f} s left] {} {} {}: {}{}{} ({:.2f} CPU s)", done_, queued_, all_queued_ ? "" : "+", elapsed, left,
                             all.value->id, all.engines[run.engine].name, run.plan.label, run.kept ? "kept, " : "", run.row.status, run.row.reason.empty() ? "" : ", " + run.row.reason, run.row.cost.cpu_s));
  }

  const std::vector<Case>& cases_;
  const std::vector<EngineEntry>& engines_;
  const SuiteOptions& options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Work> queue_;
  std::vector<Slot> slots_;
  std::size_t queued_ = 0, done_ = 0, announced_ = 0;
  bool all_queued_ = false;
  std::exception_ptr failure_;  ///< of a worker, the first
  std::atomic<bool> given_up_{false};
};

}  // namespace

Results run_suite(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines, const SuiteOptions& options) {
  Results results;
  results.tool = this_tool();
  results.seed = options.selection.seed.value_or(1);
  results.only_engines = options.selection.engines, results.asked = options.selection.asked;
  results.seed_given = options.selection.seed.has_value();
  for (const auto& c : cases) results.planned.push_back(c.id);
  results.cases = Suite(cases, engines, options).run();
  results.interrupted = interrupted() && results.cases.size() < cases.size();
  judge(results);
  return results;
}

}  // namespace tripoint
