// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/frames.hpp"

#include <charconv>
#include <cmath>

#include "validation/metrics/norms.hpp"

namespace tripoint {
namespace {

std::string wrong_rows(const Snapshot& frame, const Job& job, const InitialState& initial) {
  if (frame.gauges_only()) return {};
  const std::size_t n = initial.size(),
                    rows = frame.position.empty() ? frame.temperature.size() : frame.position.size();
  if (rows != n && (job.scene.inflows.empty() || rows < n))
    return "the frame at t = " + std::to_string(frame.time) + " s has " + std::to_string(rows) +
           " particles, the job " + std::to_string(n);
  for (std::size_t i = 0; i < frame.id.size(); ++i)
    if (frame.id[i] != static_cast<int>(i) && frame.id[i] != -1)
      return "ids are permuted: row " + std::to_string(i) + " holds particle " + std::to_string(frame.id[i]) +
             " at t = " + std::to_string(frame.time) + " s";
  return {};
}

}  // namespace

double time_tolerance(const Job& job) {
  return 1e-9 * (job.times.empty() ? job.scene.end_time : std::abs(job.times.back()));
}

JobFrames frames_of_job(const Job& job, const InitialState& initial, const Trajectory& run) {
  JobFrames out;
  if (run.frames.empty()) return {{}, "the trajectory is empty"};
  if (job.times.empty()) return {{}, "the job has no output times"};
  for (std::size_t n = 1; n < run.frames.size(); ++n)
    if (!(run.frames[n].time > run.frames[n - 1].time))
      return {{}, "times do not increase at frame " + std::to_string(n)};
  std::size_t at = 0;
  for (const double time : job.times) {
    while (at < run.frames.size() && run.frames[at].time < time - time_tolerance(job)) ++at;
    if (at == run.frames.size() || !(std::abs(run.frames[at].time - time) <= time_tolerance(job)))
      return {{}, "time not reached: no frame at t = " + std::to_string(time) + " s"};
    if (auto why = wrong_rows(run.frames[at], job, initial); !why.empty()) return {{}, why};
    out.list.push_back(&run.frames[at]);
  }
  return out;
}

Frames frames_in_window(const MetricChoice& choice, const Job& job, const Frames& frames) {
  const auto [from, to] = choice.window;
  if (from == 0.0 && to == 0.0) return frames;
  Frames list;
  for (const auto* f : frames)
    if (f->time >= from - time_tolerance(job) && f->time <= to + time_tolerance(job)) list.push_back(f);
  return list;
}

Frames chosen_frames(const MetricChoice& choice, const Job& job, const Frames& frames) {
  if (!is_spatial(choice.norm)) return frames_in_window(choice, job, frames);
  if (choice.at == "end" || choice.at.empty()) return {frames.back()};
  if (choice.at == "all") return frames_in_window(choice, job, frames);
  double time = 0.0;
  const char *first = choice.at.data(), *last = first + choice.at.size();
  const auto [stop, error] = std::from_chars(first, last, time);
  const std::string unit(stop, last);
  if (error != std::errc() || (!unit.empty() && unit != " s" && unit != "s"))
    throw InputError(choice.place,
                     "metric `" + choice.name + "`: `at` must be \"end\", \"all\" or a time in seconds");
  for (const auto* f : frames)
    if (std::abs(f->time - time) <= time_tolerance(job)) return {f};
  throw InputError(choice.place, "metric `" + choice.name + "`: `at` is no output time of the scene");
}

}  // namespace tripoint
