// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/make_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/durable_file.hpp"
#include "validation/campaign/case_run.hpp"
#include "validation/case/case.hpp"
#include "validation/queue/cost.hpp"
#include "validation/queue/published.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// Jobs of one case. Its particles are sampled here, since they are part of a run's identity.
void add_jobs(const Case& value, const std::vector<EngineEntry>& engines, const SuiteOptions& options,
              const std::map<std::string, double>& costs, QueueMade& made) {
  const auto all = prepare_case(value, engines, options);
  for (const auto& run : all.runs) {
    QueuedJob job;
    const auto& engine = all.engines[run.engine];
    job.id = run_id(all, run, options);
    job.case_id = value.id;
    job.engine = engine.name;
    job.preset = engine.preset;
    job.label = run.plan.label;
    const auto known = costs.find(run_folder(job));
    made.measured += known == costs.end() ? 0 : 1;
    job.cost =
        known == costs.end() ? predicted_cost(run.job, engine.name, run.initial->size()) : known->second;
    made.queue.jobs.push_back(std::move(job));
  }
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

void touch(const std::string& path) { write_by_rename(path, "", "make"); }

/// Ids that a worker holds; whether it lives is not asked here.
std::set<std::string> claimed(const std::string& dir) {
  std::set<std::string> ids;
  for (const auto& name : names_in(fs::path(dir) / state::running))
    ids.insert(name.substr(0, name.find('.')));
  return ids;
}

/// Every job of the suite stands somewhere: those that are nowhere wait. @return how many have a result
std::size_t lay_out(const std::string& dir, const Queue& queue) {
  const auto todo = names_in(fs::path(dir) / state::todo), running = claimed(dir),
             done = names_in(fs::path(dir) / state::done), failed = names_in(fs::path(dir) / state::failed);
  std::set<std::string> wanted;
  std::size_t kept = 0;
  for (const auto& job : queue.jobs) {
    wanted.insert(job.id);
    const bool ended = done.count(job.id) + failed.count(job.id) > 0 && published_id(dir, job) == job.id;
    kept += ended ? 1 : 0;
    if (ended || running.count(job.id) > 0 || todo.count(job.id) > 0) continue;
    // Its runs are gone
    for (const auto* old : {state::done, state::failed}) fs::remove(place(dir, old, job.id));
    touch(place(dir, state::todo, job.id));
  }
  for (const auto& id : todo)
    if (wanted.count(id) == 0) fs::remove(place(dir, state::todo, id));
  return kept;
}

}  // namespace

QueueMade make_queue(const std::string& dir, Queue wanted, const std::vector<Case>& cases,
                     const std::vector<EngineEntry>& engines, const std::map<std::string, double>& costs) {
  QueueMade made;
  made.queue = std::move(wanted);
  for (const char* name :
       {state::todo, state::running, state::done, state::failed, state::lost, state::doubled, state::workers})
    fs::create_directories(fs::path(dir) / name);
  auto options = options_of(made.queue);
  options.out = dir;
  options.plans_alone = true;
  for (const auto& value : cases) {
    made.queue.cases.push_back({value.id, value.file});
    add_jobs(value, engines, options, costs, made);
  }
  if (made.queue.jobs.empty())
    throw InputError("no engine that is here runs any of these cases: there are no jobs");
  write_durably((fs::path(dir) / "suite.json").string(), queue_text(made.queue));
  made.kept = lay_out(dir, made.queue);
  return made;
}

std::size_t retry_failed(const std::string& dir, const Queue& queue, const std::vector<std::string>& ids) {
  for (const auto& id : ids)
    if (!fs::exists(place(dir, state::failed, id)))
      throw InputError(id + ": is no failed job of this suite (tripoint status names them)");
  std::size_t count = 0;
  for (const auto& job : queue.jobs) {
    if (!ids.empty() && std::find(ids.begin(), ids.end(), job.id) == ids.end()) continue;
    if (!fs::exists(place(dir, state::failed, job.id))) continue;
    withdraw(dir, job);
    for (const auto& note : names_in(fs::path(dir) / state::lost))
      if (note.starts_with(job.id + ".")) fs::remove(place(dir, state::lost, note));
    fs::rename(place(dir, state::failed, job.id), place(dir, state::todo, job.id));
    ++count;
  }
  return count;
}

}  // namespace tripoint
