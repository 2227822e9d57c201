// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/engine.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
enum Exit { ok = 0, failed = 1, bad_job = 2, refused = 4, diverged = 7 };

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// FNV-1a over a file's bytes: tells two builds of a library apart.
std::string hash_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (path.empty() || !in) return "";
  std::uint64_t hash = 1469598103934665603ULL;
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0)
    for (std::streamsize k = 0; k < in.gcount(); ++k) hash = (hash ^ static_cast<unsigned char>(block[k])) * 1099511628211ULL;
  return fmt::format("fnv1a64:{:016x}", hash);
}

int print_info(const Engine& engine) {
  const EngineInfo info = engine.info();
  json defects = json::array();
  for (const DefectEntry& d : info.defects) defects.push_back({{"name", d.name}, {"what", d.what}, {"case", d.case_id}});
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

int print_check(const Engine& engine, const std::string& path) {
  const std::string reason = engine.refusal(read_job(path));
  fmt::print("{}\n", json{{"can", reason.empty()}, {"reason", reason}}.dump());
  return ok;
}

/// One run: frames are announced on stderr once they are safe in the file; result.json is the last act.
class Run {
 public:
  Run(Engine& engine, Job job) : engine_(engine), job_(std::move(job)) {
    std::filesystem::create_directories(job_.output);
    result_path_ = job_.output + "/result.json";
    std::filesystem::remove(result_path_);
  }

  int go() {
    try {
      result_.message = engine_.refusal(job_);
      if (!result_.message.empty()) return finish("refused", Exit::refused);
      set_up();
      step_to_the_end();
      return finish("ok", Exit::ok);
    } catch (const Diverged& e) {
      result_.message = e.what();
      result_.divergence = Divergence{e.particle, e.body, e.field, e.stage, e.time};
      account();
      return finish("diverged", Exit::diverged);
    } catch (const std::exception& e) {
      result_.message = e.what();
      const int code = finish("error", Exit::failed);
      std::fflush(nullptr);
      ::_exit(code);  // HDF5's own clean-up crashes after a failed write
    }
  }

 private:
  void set_up() {
    const double cpu = cpu_seconds(), wall = wall_seconds();
    engine_.load(job_, read_particles(job_.particles));
    result_.setup_cpu = cpu_seconds() - cpu;
    result_.setup_wall = wall_seconds() - wall;
    result_.readback = engine_.readback();
  }

  void step_to_the_end() {
    TrajectoryWriter writer(job_.output + "/trajectory.h5");
    std::vector<double> times;
    Snapshot frame;
    for (const double time : job_.times) {
      const double cpu = cpu_seconds(), wall = wall_seconds();
      if (time > job_.times.front()) engine_.advance_to(time);
      result_.stepping_cpu += cpu_seconds() - cpu;
      result_.stepping_wall += wall_seconds() - wall;
      frame = engine_.observe();
      writer.append(frame);
      times.push_back(frame.time);
      result_.time_reached = frame.time;
      fmt::print(stderr, "frame {} t {:.9g} s\nprogress {:.4f}\n", writer.frames() - 1, frame.time, (time - job_.times.front()) / std::max(job_.times.back() - job_.times.front(), 1e-300));
    }
    account();
    result_.state_hash = state_hash(frame);
    writer.close();
    write_xdmf(job_.output, times, frame);
  }

  void account() { engine_.account(result_); }

  int finish(const char* status, int code) {
    result_.status = status;
    if (!result_.message.empty()) fmt::print(stderr, "{}: {}\n", status, result_.message);
    try {
      write_result(result_path_, result_);
    } catch (const std::exception& e) {
      fmt::print(stderr, "error: {}\n", e.what());
      return Exit::failed;
    }
    return code;
  }

  Engine& engine_;
  Job job_;
  std::string result_path_;
  Result result_;
};

int usage(const char* program) {
  fmt::print(stderr, "usage: {0} --info | --check JOB.json | --run JOB.json\nAn engine of tripoint; `tripoint run CASE --engine NAME` writes the job and calls it.\n", program);
  return bad_job;
}

}  // namespace

int serve(int argc, char** argv, MakeEngine make) {
  const std::string verb = argc > 1 ? argv[1] : "";
  try {
    const std::unique_ptr<Engine> engine = make();
    if (verb == "--info" && argc == 2) return print_info(*engine);
    if (verb == "--check" && argc == 3) return print_check(*engine, argv[2]);
    if (verb == "--run" && argc == 3) return Run(*engine, read_job(argv[2])).go();
    return usage(argv[0]);
  } catch (const InputError& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return bad_job;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return failed;
  }
}

}  // namespace tripoint
