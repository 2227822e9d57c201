// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/standing.hpp"

#include <algorithm>
#include <filesystem>
#include <unordered_map>
#include <unordered_set>

#include "core/errors.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> names_in(const std::string& dir, const char* name) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(fs::path(dir) / name, error), end; !error && at != end;
       at.increment(error)) {
    auto file = at->path().filename().string();
    if (!file.ends_with(".part")) names.push_back(std::move(file));
  }
  if (error)
    throw InputError((fs::path(dir) / name).string() + ": cannot be read: " + error.message() +
                     " (tripoint suite make lays it out again)");
  return names;
}

/// "ID.WORKER" -> both parts; an id has no dot.
std::pair<std::string, std::string> parts_of(const std::string& name) {
  const auto dot = std::min(name.find('.'), name.size());
  return {name.substr(0, dot), name.substr(std::min(dot + 1, name.size()))};
}

}  // namespace

std::size_t Standing::count(Stand stand) const {
  return static_cast<std::size_t>(
      std::count_if(jobs.begin(), jobs.end(), [&](const JobStand& j) { return j.stand == stand; }));
}

Standing look(const std::string& dir, const Queue& queue) {
  Standing all;
  // In the order in which a job goes: one that moves on meanwhile is seen once more, never missed.
  const auto todo_names = names_in(dir, state::todo), running = names_in(dir, state::running),
             failed_names = names_in(dir, state::failed), done_names = names_in(dir, state::done);
  const std::unordered_set<std::string> todo(todo_names.begin(), todo_names.end()),
      failed(failed_names.begin(), failed_names.end()), done(done_names.begin(), done_names.end());
  const double now = file_clock(dir);
  for (const auto& name : names_in(dir, state::workers))
    if (name.ends_with(".json")) all.workers[name.substr(0, name.size() - 5)] = {};
  std::unordered_map<std::string, std::string> holder;
  for (const auto& name : running) {
    const auto [id, worker] = parts_of(name);
    holder[id] = worker;
    all.workers[worker] = {};
  }
  std::map<std::string, bool> alive;
  for (auto& [name, sign] : all.workers) {
    sign = read_sign(dir, name, now);
    alive[name] = is_alive(sign);
  }
  for (const auto& name : names_in(dir, state::lost)) ++all.losses[parts_of(name).first];
  all.doubled = names_in(dir, state::doubled);
  for (const auto& job : queue.jobs) {
    JobStand stand;
    const auto held = holder.find(job.id);
    if (held != holder.end()) stand.worker = held->second;
    if (done.count(job.id))
      stand.stand = Stand::done;
    else if (failed.count(job.id))
      stand.stand = Stand::failed;
    else if (held != holder.end())
      stand.stand = alive[held->second] ? Stand::running : Stand::lost;
    else if (todo.count(job.id))
      stand.stand = Stand::waiting;
    all.jobs.push_back(std::move(stand));
  }
  return all;
}

}  // namespace tripoint
