// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

/// The note that a job left when it ended; an empty object where it cannot be read.
Json note_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  auto note = in ? Json::parse(in, nullptr, false) : Json();
  return note.is_object() ? note : Json::object();
}

std::string reason_of(const std::string& dir, const QueuedJob& job) {
  const auto note = note_of(place(dir, state::failed, job.id));
  return fmt::format("{}: {}", note.value("status", "failed"), note.value("reason", "it left no reason"));
}

/// Evenly over the jobs that are done.
void learn_speed(const std::string& dir, const Queue& queue, std::size_t sample, QueueStatus& status) {
  const auto done = status.standing.count(Stand::done);
  const std::size_t every = std::max<std::size_t>(1, done / std::max<std::size_t>(1, sample));
  double took = 0.0, predicted = 0.0;
  std::size_t seen = 0;
  for (std::size_t n = 0; n < queue.jobs.size(); ++n) {
    if (status.standing.jobs[n].stand != Stand::done || seen++ % every != 0) continue;
    const auto note = note_of(place(dir, state::done, queue.jobs[n].id));
    took += note.value("wall_s", 0.0);
    predicted += queue.jobs[n].cost;
    ++status.sampled;
  }
  if (took > 0.0 && predicted > 0.0) status.speed = took / predicted;
}

std::string duration(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

constexpr std::size_t most_lines = 20;

/// Lines of the jobs that stand so, the first of them.
std::string lines_of(const Queue& queue, const Standing& standing, Stand stand, const char* word,
                     const std::function<std::string(std::size_t)>& more) {
  std::string text;
  std::size_t count = 0;
  for (std::size_t n = 0; n < queue.jobs.size(); ++n) {
    if (standing.jobs[n].stand != stand || ++count > most_lines) continue;
    text += one_line(fmt::format("{:8} {}  {}{}", word, queue.jobs[n].id, name_of(queue.jobs[n]), more(n))) +
            "\n";
  }
  if (count > most_lines)
    text += fmt::format("{:8} and {} more (--json has all)\n", word, count - most_lines);
  return text;
}

Json json(const Queue& queue, const Standing& standing, Stand stand,
          const std::function<void(std::size_t, Json&)>& more) {
  Json list = Json::array();
  for (std::size_t n = 0; n < queue.jobs.size(); ++n) {
    if (standing.jobs[n].stand != stand) continue;
    const auto& j = queue.jobs[n];
    Json row{{"id", j.id},         {"case", j.case_id}, {"engine", j.engine},
             {"preset", j.preset}, {"run", j.label},    {"worker", standing.jobs[n].worker}};
    more(n, row);
    list.push_back(row);
  }
  return list;
}

}  // namespace

QueueStatus status_of(const std::string& dir, const Queue& queue, std::size_t sample) {
  QueueStatus status;
  status.standing = look(dir, queue);
  std::set<std::string> busy;
  for (std::size_t n = 0; n < queue.jobs.size(); ++n) {
    const auto& job = status.standing.jobs[n];
    if (job.stand == Stand::running) busy.insert(job.worker);
    if (job.stand == Stand::running) status.rest += 0.5 * queue.jobs[n].cost;
    if (job.stand == Stand::waiting || job.stand == Stand::lost) status.rest += queue.jobs[n].cost;
  }
  status.busy_workers = static_cast<int>(busy.size());
  learn_speed(dir, queue, sample, status);
  status.seconds_left = status.rest * status.speed / std::max(1, status.busy_workers);
  return status;
}

std::string status_text(const std::string& dir, const Queue& queue, const QueueStatus& status) {
  const auto& all = status.standing;
  const auto open = all.count(Stand::waiting) + all.count(Stand::running) + all.count(Stand::lost);
  std::string text = fmt::format("{}: {} jobs of {} cases\n", dir, queue.jobs.size(), queue.cases.size());
  text += fmt::format("done {}  running {}  waiting {}  lost {}  failed {}  doubled {}\n",
                      all.count(Stand::done), all.count(Stand::running), all.count(Stand::waiting),
                      all.count(Stand::lost), all.count(Stand::failed), all.doubled.size());
  if (open > 0) {
    const auto workers = status.busy_workers == 0 ? std::string("one worker; none is at it")
                                                  : fmt::format("{} worker{}", status.busy_workers,
                                                                status.busy_workers == 1 ? "" : "s");
    const auto basis =
        status.sampled == 0
            ? std::string("by prediction alone")
            : fmt::format("by prediction, and what is done took {:.2g} times what was predicted",
                          status.speed);
    text += fmt::format("about {} left with {} ({})\n", duration(status.seconds_left), workers, basis);
  }
  text += lines_of(queue, all, Stand::running, "running",
                   [&](std::size_t n) { return "  by " + all.jobs[n].worker; });
  text += lines_of(queue, all, Stand::lost, "lost", [&](std::size_t n) {
    return all.jobs[n].worker.empty() ? "  its file was taken away"
                                      : "  was held by " + all.jobs[n].worker + ", which is gone";
  });
  text += lines_of(queue, all, Stand::failed, "failed",
                   [&](std::size_t n) { return "  " + reason_of(dir, queue.jobs[n]); });
  for (std::size_t n = 0; n < std::min(all.doubled.size(), most_lines); ++n)
    text += fmt::format("{:8} {}  {}\n", "doubled", all.doubled[n],
                        note_of(place(dir, state::doubled, all.doubled[n])).value("same", false)
                            ? "same result"
                            : "ANOTHER result");
  if (open > 0)
    text += fmt::format("next: tripoint suite work {}   (lost jobs are taken over)\n", dir);
  else
    text += fmt::format(
        "next: tripoint merge {}{}\n", dir,
        all.count(Stand::failed) > 0 ? "   (or tripoint suite retry, then work, for what failed)" : "");
  return text;
}

std::string status_json(const std::string& dir, const Queue& queue, const QueueStatus& status) {
  const auto& all = status.standing;
  Json workers = Json::array(), doubled = Json::array();
  std::map<std::string, int> holds;
  for (const auto& job : all.jobs)
    if (job.stand == Stand::running || job.stand == Stand::lost) ++holds[job.worker];
  for (const auto& [name, sign] : all.workers)
    workers.push_back({{"name", name},
                       {"host", sign.host},
                       {"alive", is_alive(sign)},
                       {"sign_age_s", std::isfinite(sign.age) ? Json(sign.age) : Json(nullptr)},
                       {"jobs", holds[name]}});
  for (const auto& name : all.doubled)
    doubled.push_back({{"id", name.substr(0, name.find('.'))},
                       {"worker", name.substr(std::min(name.size(), name.find('.') + 1))},
                       {"same", note_of(place(dir, state::doubled, name)).value("same", false)}});
  const auto nothing = [](std::size_t, Json&) {};
  const Json document{
      {"format", 1},
      {"folder", dir},
      {"jobs", queue.jobs.size()},
      {"cases", queue.cases.size()},
      {"done", all.count(Stand::done)},
      {"running", all.count(Stand::running)},
      {"waiting", all.count(Stand::waiting)},
      {"lost", all.count(Stand::lost)},
      {"failed", all.count(Stand::failed)},
      {"doubled", all.doubled.size()},
      {"rest_cpu_s", status.rest},
      {"speed", status.speed},
      {"seconds_left", status.seconds_left},
      {"busy_workers", status.busy_workers},
      {"workers", workers},
      {"running_jobs", json(queue, all, Stand::running, nothing)},
      {"lost_jobs", json(queue, all, Stand::lost, nothing)},
      {"failed_jobs", json(queue, all, Stand::failed,
                           [&](std::size_t n, Json& row) { row["reason"] = reason_of(dir, queue.jobs[n]); })},
      {"doubled_jobs", doubled}};
  return json_text(document);
}

}  // namespace tripoint
