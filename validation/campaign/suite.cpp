// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/suite.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/judge/judge.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/run/finished_run.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

/// Workers prepare the cases in order and make their runs, no more of either at a time than there are jobs. A
/// case is prepared when the waiting runs are fewer than the jobs. So the particles of a few cases are held
/// and not those of all. Results keep the order of the cases whatever ends first.
class Suite {
 public:
  Suite(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines, const SuiteOptions& options)
      : cases_(cases),
        options_(options),
        jobs_(static_cast<std::size_t>(std::max(1, options.jobs))),
        slots_(cases.size()) {
    for (std::size_t c = 0; c < cases.size(); ++c) {
      slots_[c].runs = std::make_unique<CaseRuns>(plan_case(cases[c], engines, options));
      all_runs_ += number_of_runs(*slots_[c].runs, options);
    }
  }

  std::vector<CaseResult> run() {
    std::vector<std::thread> workers;
    for (std::size_t i = 0; i < jobs_; ++i) workers.emplace_back([this] { work(); });
    for (auto& w : workers) w.join();
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

  [[nodiscard]] bool wants_a_case() const {
    return !preparing_ && prepared_ < cases_.size() && queue_.size() < jobs_;
  }
  [[nodiscard]] bool is_over() const {
    return given_up_ || interrupted() || (!preparing_ && prepared_ == cases_.size() && queue_.empty());
  }

  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_over() || wants_a_case() || !queue_.empty(); });
      if (is_over()) return;
      if (wants_a_case())
        prepare_next(lock);
      else
        make_next(lock);
    }
  }

  void prepare_next(std::unique_lock<std::mutex>& lock) {
    const std::size_t c = prepared_;
    preparing_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      add_runs(*slots_[c].runs, options_);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::size_t n = slots_[c].runs->runs.size();
    lock.lock();
    preparing_ = false;
    ++prepared_;
    if (failure) {
      // a suite stopped half-way is no failure: the complete cases are reported
      if (!interrupted()) give_up(failure);
      given_up_ = true;
    } else {
      slots_[c].left = n;
      for (std::size_t r = 0; r < n; ++r) queue_.push_back({c, r});
    }
    lock.unlock();
    changed_.notify_all();
    if (n == 0 && !failure) finish(c);
  }

  void make_next(std::unique_lock<std::mutex>& lock) {
    const auto next = queue_.front();
    queue_.pop_front();
    lock.unlock();
    changed_.notify_all();
    try {
      make(next);
    } catch (...) {
      lock.lock();
      give_up(std::current_exception());
    }
    changed_.notify_all();
  }

  void give_up(std::exception_ptr failure) {
    if (!failure_) failure_ = std::move(failure);
    given_up_ = true;
  }

  void make(const Work& next) {
    auto& slot = slots_[next.slot];
    const CaseRun& run = slot.runs->runs[next.run];
    make_run(*slot.runs, slot.runs->runs[next.run], options_);
    if (options_.on_run) options_.on_run(*slot.runs, run);
    say_run(*slot.runs, run);
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
    ::malloc_trim(0);  // frames of many engines: else the allocator keeps what every worker has freed
    for (; announced_ < slots_.size() && slots_[announced_].result; ++announced_)
      if (options_.on_case) options_.on_case(*slots_[announced_].result);
  }

  void say_run(const CaseRuns& all, const CaseRun& run) {
    if (!options_.say) return;
    const std::lock_guard lock(mutex_);
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    ++done_;
    if (run.taken && !options_.are_all_made) return;  // it was reported when it was made
    const double left = elapsed / static_cast<double>(done_) * static_cast<double>(all_runs_ - done_);
    options_.say(fmt::format("[{:3}/{}  {:.0f} s, about {:.0f} s left] {} {} {}: {}{}{} ({:.2f} CPU s)",
                             done_, all_runs_, elapsed, left, all.value->id, all.engines[run.engine].name,
                             run.plan.label, run.kept ? "kept, " : "", run.row.status,
                             run.row.reason.empty() ? "" : ", " + run.row.reason, run.row.cost.cpu_s));
  }

  const std::vector<Case>& cases_;
  const SuiteOptions& options_;
  const std::size_t jobs_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Work> queue_;
  std::vector<Slot> slots_;
  std::size_t all_runs_ = 0, done_ = 0, announced_ = 0;
  std::size_t prepared_ = 0;    ///< cases
  bool preparing_ = false;      ///< a worker prepares a case
  std::exception_ptr failure_;  ///< the first
  std::atomic<bool> given_up_{false};
};

}  // namespace

namespace {

/// Third-party runs, which end before those begin whose results are the truth that they are judged by, or
/// that they could copy. In a sandbox an engine sees neither.
class ThirdPartiesFirst {
 public:
  ThirdPartiesFirst(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines,
                    const SuiteOptions& options)
      : cases_(cases), engines_(engines), options_(options) {}

  std::vector<CaseResult> run() {
    const bool third_parties = has_runs(true), others = has_runs(false);
    SuiteOptions options = options_;
    if (third_parties)
      options.before_third_party = [this] { std::call_once(hidden_, [this] { hide_answers(); }); };
    if (!third_parties || !others) return Suite(cases_, engines_, options).run();
    options.settled = std::make_shared<std::map<std::string, std::shared_ptr<const InitialState>>>();
    make_third_party_runs(options);
    options.before_third_party = {};
    options.are_all_made = false;
    options.made = [this](const CaseRuns& all, const CaseRun& run) { return made_before(all, run); };
    return Suite(cases_, engines_, options).run();
  }

 private:
  /// Whether third-party runs, or the others, are planned.
  [[nodiscard]] bool has_runs(bool of_third_parties) const {
    SuiteOptions options = options_;
    options.wanted = only(of_third_parties);
    return std::ranges::any_of(cases_, [&](const Case& c) {
      CaseRuns all;
      all.engines = plan_runs(c, engines_, options.selection);
      return number_of_runs(all, options) > 0;
    });
  }

  [[nodiscard]] std::function<bool(const EnginePlan&, const RunPlan&)> only(bool third_parties) const {
    return [this, third_parties](const EnginePlan& engine, const RunPlan& plan) {
      return belongs_to_us(engine.entry->executable) != third_parties &&
             (!options_.wanted || options_.wanted(engine, plan));
    };
  }

  void make_third_party_runs(SuiteOptions options) {
    options.wanted = only(true);
    options.on_case = {};
    options.on_run = [this](const CaseRuns& all, const CaseRun& run) {
      const std::lock_guard lock(mutex_);
      made_[run_id(all, run, options_)] = {run.row, run.ledger};
    };
    static_cast<void>(Suite(cases_, engines_, options).run());
  }

  std::optional<MadeRun> made_before(const CaseRuns& all, const CaseRun& run) const {
    const auto at = made_.find(run_id(all, run, options_));
    return at == made_.end() ? std::optional<MadeRun>() : at->second;
  }

  /// Results of earlier calls that lie in the folder of this one, but for those of third parties, which
  /// --resume may keep.
  void hide_answers() const {
    std::set<std::string> third_parties;
    for (const EngineEntry& e : engines_)
      if (!belongs_to_us(e.executable)) third_parties.insert(e.name);
    const auto removed =
        remove_answers((std::filesystem::path(options_.out) / "runs").string(), third_parties);
    if (removed > 0 && options_.say)
      options_.say(
          fmt::format("{} files of earlier runs were removed from {}/runs: an engine of somebody else runs "
                      "without --sandbox",
                      removed, options_.out));
  }

  const std::vector<Case>& cases_;
  const std::vector<EngineEntry>& engines_;
  const SuiteOptions& options_;
  std::once_flag hidden_;
  std::mutex mutex_;
  std::map<std::string, MadeRun> made_;  ///< by run_id
};

std::vector<CaseResult> results_of(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines,
                                   const SuiteOptions& options) {
  if (third_parties_are_sandboxed() || options.made || options.plans_alone)
    return Suite(cases, engines, options).run();
  return ThirdPartiesFirst(cases, engines, options).run();
}

}  // namespace

Results run_suite(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines,
                  const SuiteOptions& options) {
  Results results;
  results.tool = this_tool();
  results.seed = options.selection.seed.value_or(1);
  results.only_engines = options.selection.engines;
  results.asked = options.selection.asked;
  results.seed_given = options.selection.seed.has_value();
  for (const auto& c : cases) results.planned.push_back(c.id);
  results.cases = results_of(cases, engines, options);
  results.interrupted = interrupted() && results.cases.size() < cases.size();
  judge(results);
  return results;
}

}  // namespace tripoint
