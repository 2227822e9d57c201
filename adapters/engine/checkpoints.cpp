// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/engine/checkpoints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/durable_file.hpp"
#include "files/checkpoint_file.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* interval_key = "checkpoint_interval";

/// The job without what may change when it is continued.
std::string scene_hash(Job job) {
  job.case_id = job.particles = job.output = job.resume = "";
  job.reference = {};
  job.threads = job.ranks = 1;
  job.settings.erase("ranks");
  job.times = {};
  job.scene.end_time = 0.0;
  job.settings.erase(interval_key);
  return text_hash(job_text(job));
}

std::string earlier_trajectory(const Job& job) {
  return (fs::path(job.resume).parent_path() / "trajectory.h5").string();
}

template <class Values>
const Values& take(const std::map<std::string, Values>& arrays, const std::string& name,
                   const std::string& path) {
  const auto at = arrays.find(name);
  if (at == arrays.end() || at->second.empty()) throw InputError(path + ": has no " + name);
  return at->second;
}

/// Times up to the one that the run was on its way to must be times of this job. Otherwise its steps would
/// not be those of the whole run.
void expect_times(const Job& job, const std::vector<double>& times) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k < job.times.size() && job.times[k] == times[k]) continue;
    throw InputError(
        fmt::format("{}: its run {} t = {:.17g} s, which is no output time of this one: keep "
                    "output_interval, and an end that "
                    "comes no sooner",
                    job.resume, k + 1 < times.size() ? "showed" : "was on its way to", times[k]));
  }
}

}  // namespace

std::vector<std::string> identity_of(const Job& job, const InitialState& initial, const std::string& build) {
  return {"scene " + scene_hash(job), "particles " + state_hash(initial), "build " + build};
}

Checkpoints::Checkpoints(const Job& job, std::vector<std::string> identity)
    : job_(job), identity_(std::move(identity)) {
  const auto at = job.settings.find(interval_key);
  if (at == job.settings.end()) return;
  const double* interval = std::get_if<double>(&at->second);
  if (!interval || !(*interval > 0.0))
    throw InputError(std::string(interval_key) + " must be a time above 0, in seconds");
  interval_ = *interval;
}

long Checkpoints::multiples(double time) const {
  return interval_ > 0.0 ? static_cast<long>(std::floor(time / interval_)) : 0;
}

double Checkpoints::go_on_from(const Checkpoint& kept) {
  const double time = take(kept.real, "run/time", job_.resume)[0];
  passed_ = multiples(time);
  std::error_code ignored;
  if (fs::equivalent(fs::path(job_.resume).parent_path(), job_.output, ignored)) kept_ = {job_.resume};
  return time;
}

bool Checkpoints::due(double time) {
  const long before = passed_;
  passed_ = multiples(time);
  return passed_ > before;
}

std::string Checkpoints::write(Checkpoint kept, double time, long step, const Progress& progress) {
  kept.text["run/identity"] = identity_;
  kept.text["run/frames_hash"] = {progress.hash.text()};
  kept.real["run/time"] = {time};
  kept.whole["run/frames"] = {static_cast<std::int64_t>(progress.frames)};
  kept.real["run/times"].assign(job_.times.begin(),
                                job_.times.begin() + static_cast<std::ptrdiff_t>(progress.frames) + 1);
  // Frames that the checkpoint counts on must not be in memory only.
  if (const std::string frames = job_.output + "/trajectory.h5"; fs::exists(frames)) make_durable(frames);
  const std::string path = (fs::path(job_.output) / fmt::format("checkpoint-{:09}.h5", step)).string();
  write_checkpoint(path, kept);
  if (kept_.empty() || kept_.back() != path) kept_.push_back(path);
  std::error_code ignored;
  for (; kept_.size() > 2; kept_.pop_front()) fs::remove(kept_.front(), ignored);
  return path;
}

std::string Checkpoints::last() const {
  return kept_.empty() ? "" : fs::path(kept_.back()).filename().string();
}

Checkpoint open_checkpoint(const Job& job, const std::vector<std::string>& identity) {
  Checkpoint kept = read_checkpoint(job.resume);
  const std::vector<std::string>& theirs = take(kept.text, "run/identity", job.resume);
  for (std::size_t k = 0; k < identity.size(); ++k) {
    if (k < theirs.size() && theirs[k] == identity[k]) continue;
    const std::string what = identity[k].substr(0, identity[k].find(' '));
    throw InputError(fmt::format("{}: is of another {}: it holds \"{}\", this run is \"{}\"", job.resume,
                                 what, k < theirs.size() ? theirs[k] : "", identity[k]));
  }
  expect_times(job, take(kept.real, "run/times", job.resume));
  return kept;
}

std::vector<Snapshot> earlier_frames(const Job& job, const Checkpoint& kept) {
  const std::string path = earlier_trajectory(job);
  std::vector<Snapshot> frames = read_trajectory(path).frames;
  const auto wanted = static_cast<std::size_t>(take(kept.whole, "run/frames", job.resume)[0]);
  FramesHash hash;
  if (frames.size() > wanted) frames.resize(wanted);
  for (Snapshot& frame : frames) {
    // Bodies born in later frames
    while (!frame.bodies.empty() && std::isnan(frame.bodies.back().mass)) frame.bodies.pop_back();
    hash.add(frame);
  }
  if (frames.size() == wanted && hash.text() == take(kept.text, "run/frames_hash", job.resume)[0])
    return frames;
  throw InputError(path + ": does not hold the " + std::to_string(wanted) +
                   " frames that were written before the checkpoint; keep both in one folder");
}

}  // namespace tripoint
