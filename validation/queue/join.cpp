// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/join.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "core/errors.hpp"
#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/queue/published.hpp"
#include "validation/queue/standing.hpp"
#include "validation/run/plain_tree.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

const char* word_of(Stand stand) {
  return stand == Stand::running ? "running" : stand == Stand::lost ? "lost" : "waiting";
}

/// @throws InputError naming the first jobs that have no result
void check_all_ended(const Queue& queue, const Standing& standing) {
  constexpr std::size_t most = 10;
  std::size_t open = 0;
  std::string names;
  for (const auto stand : {Stand::lost, Stand::running, Stand::waiting})  // what needs somebody's hand first
    for (std::size_t n = 0; n < queue.jobs.size(); ++n)
      if (standing.jobs[n].stand == stand && ++open <= most)
        names += fmt::format("\n  {}  {}  {}", word_of(stand), queue.jobs[n].id, name_of(queue.jobs[n]));
  if (open > 0)
    throw InputError(fmt::format("{} of {} jobs have no result yet: tripoint suite work makes them{}{}", open,
                                 queue.jobs.size(), names, open > most ? "\n  ..." : ""));
}

/// Removes the remains of killed workers of this machine.
void sweep(const std::string& dir, const Standing& standing) {
  std::error_code none;
  for (const auto& [name, sign] : standing.workers) {
    if (!is_gone(sign)) continue;
    fs::remove_all(place(dir, state::workers, name), none);
    fs::remove(place(dir, state::workers, name + ".json"), none);
  }
}

using Key = std::tuple<std::string, std::string, std::string, std::string>;

void copy_runs(const fs::path& dir, const fs::path& out) {
  std::error_code none;
  fs::create_directories(out);
  if (fs::equivalent(dir, out, none)) return;
  copy_plain_tree(dir / "runs", out / "runs");
}

}  // namespace

Results join(const std::string& dir, const Queue& queue, const std::vector<EngineEntry>& engines,
             const std::string& out, const std::function<void(const CaseResult&)>& on_case) {
  const auto standing = look(dir, queue);
  check_all_ended(queue, standing);
  sweep(dir, standing);
  std::map<Key, const QueuedJob*> jobs;
  for (const auto& job : queue.jobs) jobs[{job.case_id, job.engine, job.preset, job.label}] = &job;
  copy_runs(dir, out);
  auto options = options_of(queue);
  options.out = out;
  options.on_case = on_case;
  options.made = [&](const CaseRuns& all, const CaseRun& run) {
    const auto& engine = all.engines[run.engine];
    const auto at = jobs.find({all.value->id, engine.name, engine.preset, run.plan.label});
    const bool is_same = at != jobs.end() && run_id(all, run, options) == at->second->id;
    if (!is_same)
      throw InputError(
          fmt::format("{} {} {}: is not the run that the suite was made of: the case, the engine or this "
                      "program is another. "
                      "tripoint suite make again keeps every job that is still the same",
                      all.value->id, label_of(engine.name, engine.preset), run.plan.label));
    return published_run(dir, *at->second);
  };
  auto results = run_suite(cases_of(queue), engines, options);
  results.profile = queue.filter.profile;
  results.what = queue.filter.what;
  results.tag = queue.filter.tag;
  results.filter_known = queue.filter.substring.empty();
  return results;
}

}  // namespace tripoint
