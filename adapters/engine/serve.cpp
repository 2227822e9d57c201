// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "adapters/engine/checkpoints.hpp"
#include "adapters/engine/engine.hpp"
#include "adapters/engine/stops.hpp"
#include "core/durable_file.hpp"
#include "core/limits.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
enum Exit { ok = 0, failed = 1, bad_job = 2, refused = 4, diverged = 7, interrupted = exit_interrupted };

/// For listeners on stderr. A terminal that has closed takes no words; that is no reason to fail.
template <class... Args>
void report(fmt::format_string<Args...> format, Args&&... args) {
  const std::string words = fmt::format(format, std::forward<Args>(args)...);
  std::fwrite(words.data(), 1, words.size(), stderr);
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// FNV-1a over a file's bytes: tells two builds of a library apart.
std::string hash_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (path.empty() || !in) return "";
  std::uint64_t hash = 1469598103934665603ULL;
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0)
    for (std::streamsize k = 0; k < in.gcount(); ++k)
      hash = (hash ^ static_cast<unsigned char>(block[k])) * 1099511628211ULL;
  return fmt::format("fnv1a64:{:016x}", hash);
}

int print_info(const Engine& engine) {
  const EngineInfo info = engine.info();
  json defects = json::array();
  for (const DefectEntry& d : info.defects)
    defects.push_back({{"name", d.name}, {"what", d.what}, {"case", d.case_id}});
  const json out{{"contract", 1},
                 {"name", info.name},
                 {"version", info.version},
                 {"build", info.build},
                 {"library", {{"path", info.library_path}, {"hash", hash_of_file(info.library_path)}}},
                 {"capabilities", info.capabilities},
                 {"presets", info.presets},
                 {"settings", info.settings},
                 {"deterministic", info.deterministic},
                 {"defects", defects},
                 {"available", info.available},
                 {"reason", info.reason}};
  fmt::print("{}\n", out.dump(1));
  return ok;
}

std::string refusal(const Engine& engine, const Job& job) {
  if (!job.resume.empty() && !dynamic_cast<const Restartable*>(&engine))
    return engine.info().name + ": cannot continue from a checkpoint";
  if (std::ranges::any_of(job.scene.materials, [](const Material& m) {
        return value_of(m.values, "surface_temperature") > 0.0;
      })) {
    const EngineInfo info = engine.info();
    if (std::ranges::find(info.capabilities, "surface-temperature") == info.capabilities.end())
      return info.name + ": is not told to hold the temperature of a surface (surface_temperature)";
  }
  return engine.refusal(job);
}

int print_check(const Engine& engine, const std::string& path) {
  const Job job = read_job(path);
  std::string reason = refusal(engine, job);
  if (reason.empty() && job.resume.empty()) reason = engine.trial(job);
  fmt::print("{}\n", json{{"can", reason.empty()}, {"reason", reason}}.dump());
  return ok;
}

Domain domain_of(const Scene& scene) {
  Domain domain;
  if (scene.min) domain.min = *scene.min;
  if (scene.max) domain.max = *scene.max;
  domain.periodic = scene.periodic;
  return domain;
}

/// Sums of the ledger at the frames so far, for the run's status.
class LedgerChange {
 public:
  void add(const std::map<std::string, double>& energy) {
    if (start_.empty()) start_ = energy;
    double sum = 0.0, sizes = 0.0;
    for (const auto& [term, joule] : energy) {
      const auto at = start_.find(term);
      const double change = joule - (at == start_.end() ? 0.0 : at->second);
      sum += change;
      sizes += std::abs(change);
    }
    residual_ = sum;
    exchanged_ = std::max(exchanged_, 0.5 * sizes);
  }
  [[nodiscard]] bool has_any() const { return !start_.empty(); }
  /// Change of the sum of all terms, at the last frame [J]
  [[nodiscard]] double residual() const { return residual_; }
  /// Greatest half sum of the sizes of all changes [J]
  [[nodiscard]] double exchanged() const { return exchanged_; }

 private:
  std::map<std::string, double> start_;
  double residual_ = 0.0, exchanged_ = 0.0;
};

/// [s] of wall time between two status lines, as the caller asks for them; none without TRIPOINT_STATUS.
double status_interval() {
  const char* asked = std::getenv("TRIPOINT_STATUS");
  const double seconds = asked ? std::strtod(asked, nullptr) : 0.0;
  return seconds > 0.0 ? seconds : std::numeric_limits<double>::infinity();
}

/// A run that was asked to stop has left a checkpoint.
struct Interrupted {
  std::string checkpoint;
  double time;  ///< [s]
};

/// One run: frames are announced on stderr once they are safe in the file; result.json is the last act.
class Run {
 public:
  Run(Engine& engine, Job job)
      : engine_(engine), restartable_(dynamic_cast<Restartable*>(&engine)), job_(std::move(job)) {
    std::filesystem::create_directories(job_.output);
    result_path_ = job_.output + "/result.json";
    std::filesystem::remove(result_path_);
  }

  int go() {
    try {
      if (restartable_) catch_stops();
      result_.message = refusal(engine_, job_);
      if (!result_.message.empty()) return finish(Status::refused, Exit::refused);
      if (!sets_up()) return finish(Status::refused, Exit::refused);
      step_to_the_end();
      return finish(Status::ok, Exit::ok);
    } catch (const Interrupted& e) {
      result_.message =
          fmt::format("interrupted at t = {:.9g} s; continue with --resume {}", e.time, e.checkpoint);
      result_.time_reached = e.time;
      account();
      return finish(Status::error, Exit::interrupted);
    } catch (const Diverged& e) {
      report_failure(e);
      account();
      return finish(Status::diverged, Exit::diverged);
    } catch (const std::exception& e) {
      result_.message = with_limit(e.what());
      const int code = finish(Status::error, Exit::failed);
      std::fflush(nullptr);
      ::_exit(code);  // HDF5's own clean-up crashes after a failed write
    }
  }

 private:
  /// @return false when the scene cannot be set up, which the message then says
  bool sets_up() {
    try {
      return set_up();
    } catch (const InputError& e) {
      result_.message = engine_.info().name + ": " + e.what();
      return false;
    }
  }

  /// @return false when the checkpoint does not fit, which the message then says
  bool set_up() {
    const double cpu = cpu_seconds(), wall = wall_seconds();
    const InitialState initial = read_particles(job_.particles);
    if (restartable_)
      checkpoints_.emplace(job_,
                           identity_of(job_, initial, engine_.info().version + " " + engine_.info().build));
    engine_.load(job_, initial);
    // Of the scene as given: bodies of a run that goes on may have merged since
    result_.readback = engine_.readback();
    if (!job_.resume.empty() && !resume(initial)) return false;
    result_.setup_cpu = cpu_seconds() - cpu;
    result_.setup_wall = wall_seconds() - wall;
    return true;
  }

  bool resume(const InitialState& initial) {
    try {
      const Checkpoint kept = open_checkpoint(job_, checkpoints_->identity());
      earlier_ = earlier_frames(job_, kept);
      restartable_->resume(job_, initial, kept);
      result_.extra["resumed_at"] = checkpoints_->go_on_from(kept);
      return true;
    } catch (const InputError& e) {
      result_.message = e.what();
      return false;
    }
  }

  void step_to_the_end() {
    // Frames of a run that goes on are written beside the file that still holds them, which then is replaced
    // at once.
    const std::string path = job_.output + "/trajectory.h5",
                      begun = job_.resume.empty() ? path : path + ".part";
    TrajectoryWriter writer(begun, domain_of(job_.scene));
    for (const Snapshot& frame : earlier_) show(writer, frame);
    earlier_.clear();
    if (begun != path) put_in_place(begun, path);
    while (progress_.frames < job_.times.size()) {
      const double time = job_.times[progress_.frames];
      const double cpu = cpu_seconds(), wall = wall_seconds();
      if (time > job_.times.front()) advance_to(time);
      result_.stepping_cpu += cpu_seconds() - cpu;
      result_.stepping_wall += wall_seconds() - wall;
      last_ = engine_.observe();
      show(writer, last_);
      report_status(time);
      report("frame {} t {:.9g} s\nprogress {:.4f}\n", writer.frames() - 1, time,
             (time - job_.times.front()) / std::max(job_.times.back() - job_.times.front(), 1e-300));
    }
    account();
    result_.state_hash = state_hash(last_);
    writer.close();
    write_xdmf(job_.output, shown_, last_);
  }

  /// The file that held the frames of before the checkpoint is gone after this: all of the new one must be
  /// durable first.
  void put_in_place(const std::string& begun, const std::string& path) const {
    make_durable(begun);
    std::filesystem::rename(begun, path);
    make_durable(std::filesystem::absolute(path).parent_path().string());
  }

  void show(TrajectoryWriter& writer, const Snapshot& frame) {
    writer.append(frame);
    shown_.push_back(frame.time);
    ++progress_.frames;
    progress_.hash.add(frame);
    ledger_.add(frame.energy);
    result_.time_reached = frame.time;
  }

  /// @throws Interrupted once a checkpoint is written, when we are asked to stop
  void advance_to(double time) {
    if (!restartable_) return engine_.advance_to(time);
    restartable_->advance_to(time, [&](double now, long step) {
      report_status(now);
      const bool due = checkpoints_->due(now), stops = restartable_->stops(stop_asked());
      if (!due && !stops) return true;
      Checkpoint kept;
      restartable_->save(kept);
      const std::string path = checkpoints_->write(std::move(kept), now, step, progress_);
      report("checkpoint {} t {:.9g} s\n", path, now);
      if (stops) throw Interrupted{path, now};
      return true;
    });
  }

  /// Where the run is: `status {...}` on stderr, at most once in the interval.
  void report_status(double now) {
    if (wall_seconds() < next_status_) return;
    Result sofar;
    engine_.account(sofar);
    if (sofar.steps == 0) return;  // nothing sets a step yet
    next_status_ = wall_seconds() + status_interval_;
    json line{{"time", now}, {"end", job_.times.back()}, {"step", sofar.steps}};
    if (const auto dt = sofar.extra.find("time_step"); dt != sofar.extra.end())
      line["time_step"] = dt->second;
    if (!sofar.time_step_bound.empty()) line["bound"] = sofar.time_step_bound;
    if (ledger_.has_any()) {
      line["ledger_residual"] = ledger_.residual();
      line["ledger_exchanged"] = ledger_.exchanged();
    }
    report("status {}\n", line.dump(-1, ' ', false, json::error_handler_t::replace));
  }

  void report_failure(const Diverged& e) {
    Divergence d{e.particle,
                 e.body,
                 e.field,
                 e.stage,
                 e.time,
                 e.guard,
                 engine_.show_failure(e, job_.output),
                 checkpoints_ ? checkpoints_->last() : ""};
    result_.message = e.what();
    if (!d.file.empty()) result_.message += fmt::format("; {} shows it and what is around it", d.file);
    result_.message +=
        d.checkpoint.empty()
            ? fmt::format("; last good frame at t = {:.9g} s, no checkpoint was kept (checkpoint_interval)",
                          result_.time_reached)
            : "; last good checkpoint " + d.checkpoint;
    result_.divergence = std::move(d);
  }

  void account() { engine_.account(result_); }

  int finish(Status status, int code) {
    result_.status = status;
    if (!result_.message.empty()) report("{}: {}\n", status, result_.message);
    try {
      write_result(result_path_, result_);
    } catch (const std::exception& e) {
      report("error: {}\n", with_limit(e.what()));
      return Exit::failed;
    }
    return code;
  }

  Engine& engine_;
  Restartable* restartable_;  ///< the same engine, or nullptr
  Job job_;
  std::optional<Checkpoints> checkpoints_;
  std::vector<Snapshot> earlier_;  ///< frames before the checkpoint that we go on from
  std::vector<double> shown_;      ///< times of all frames [s]
  Snapshot last_;
  Progress progress_;
  std::string result_path_;
  Result result_;
  LedgerChange ledger_;
  double status_interval_ = status_interval(),
         next_status_ = wall_seconds() + (std::isfinite(status_interval_) ? 0.0 : status_interval_);
};

int usage(const char* program) {
  report(
      "usage: {0} --info | --check JOB.json | --run JOB.json\nAn engine of tripoint; `tripoint run CASE "
      "--engine NAME` "
      "writes the job and calls it.\n",
      program);
  return bad_job;
}

}  // namespace

int serve(int argc, char** argv, MakeEngine make) {
  const std::string verb = argc > 1 ? argv[1] : "";
  expect_file_limit();
  if (const auto why = stack_trouble(argv); !why.empty()) {
    report("error: {}\n", why);
    return bad_job;
  }
  try {
    const std::unique_ptr<Engine> engine = make();
    if (verb == "--info" && argc == 2) return print_info(*engine);
    if (verb == "--check" && argc == 3) return print_check(*engine, argv[2]);
    if (verb == "--run" && argc == 3) return Run(*engine, read_job(argv[2])).go();
    return usage(argv[0]);
  } catch (const InputError& e) {
    report("error: {}\n", e.what());
    return bad_job;
  } catch (const std::exception& e) {
    report("error: {}\n", e.what());
    return failed;
  }
}

}  // namespace tripoint
