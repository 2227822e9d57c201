// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/engine_check.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/foreign_json.hpp"
#include "files/foreign_file.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "sampling/sample.hpp"
#include "validation/case/read_case.hpp"
#include "validation/run/run_one.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// A folder that is removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "tripoint-check-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw EngineError(pattern + ": no folder can be made there");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class Checks {
 public:
  bool add(const std::string& what, bool passed, const std::string& found = {}) {
    list_.push_back({what, passed, passed ? "" : found});
    return passed;
  }
  [[nodiscard]] std::vector<EngineCheck> take() { return std::move(list_); }

 private:
  std::vector<EngineCheck> list_;
};

/// @param folder that it may write to; "" where it need write nothing
ProcessEnd ask(const std::string& executable, const std::vector<std::string>& words, double limit,
               const std::string& folder = "") {
  ProcessSpec spec;
  spec.folder = folder;
  spec.argv = {executable};
  spec.argv.insert(spec.argv.end(), words.begin(), words.end());
  spec.wall_limit = limit;
  return run_process(sandboxed(spec));
}

bool check_info(const EngineEntry& engine, Checks& checks) {
  const auto end = ask(engine.executable, {"--info"}, 10.0);
  if (!checks.add("--info exits 0 within 10 s", end.how == ProcessEnd::How::exited && end.code == 0,
                  describe(end) + " " + end.log_tail))
    return false;
  const auto info =
      unfit_json(end.output).empty() ? nlohmann::json::parse(end.output, nullptr, false) : nlohmann::json();
  if (!checks.add("--info prints one JSON object and nothing else", info.is_object(),
                  end.output.substr(0, 80)))
    return false;
  checks.add("--info says contract 1", info.value("contract", nlohmann::json()) == 1,
             info.value("contract", nlohmann::json()).dump());
  for (const char* key : {"name", "version", "build"})
    checks.add(fmt::format("--info says its {}", key),
               info.contains(key) && info[key].is_string() && !info[key].get<std::string>().empty(),
               "no text");
  for (const char* key : {"capabilities", "presets"})
    checks.add(fmt::format("--info lists its {}", key),
               info.contains(key) && info[key].is_array() && !info[key].empty(), "no list");
  checks.add("--info says whether it is deterministic",
             info.contains("deterministic") && info["deterministic"].is_boolean(), "no true or false");
  return checks.add("it is available here", engine.available, engine.reason);
}

void check_broken_jobs(const std::string& executable, const fs::path& folder, Checks& checks) {
  const auto broken = (folder / "broken.json").string(), absent = (folder / "absent.json").string();
  std::ofstream(broken) << "{";
  for (const auto& [what, job] :
       {std::pair{"a broken job", broken}, std::pair{"a job that is not there", absent}}) {
    const auto end = ask(executable, {"--run", job}, 60.0, folder.string());
    checks.add(fmt::format("--run on {} exits 2", what), end.how == ProcessEnd::How::exited && end.code == 2,
               describe(end));
  }
}

/// A scene of the check, ready to be run.
struct Prepared {
  Case value;
  Job job;
  InitialState initial;
};

Prepared prepare(const CheckScene& scene, const EngineEntry& engine, const fs::path& folder) {
  const auto file = (folder / (scene.name + ".toml")).string();
  std::ofstream(file) << scene.text;
  Prepared p;
  p.value = read_case(file).value;
  EnginePlan plan;
  plan.name = engine.name;
  plan.preset = engine.presets.front();
  RunPlan run;
  const Scene s = scene_of(p.value, run);
  p.initial = sample(s);
  p.job = make_job(p.value, plan, run, s, p.initial);
  write_particles((folder / (scene.name + ".h5")).string(), p.initial);
  return p;
}

Outcome run(const CheckScene& scene, const EngineEntry& engine, const Prepared& p, const fs::path& folder,
            const std::string& name) {
  RunRequest request;
  request.engine = &engine;
  request.job = &p.job;
  request.initial = &p.initial;
  request.folder = (folder / name).string();
  request.particles = (folder / (scene.name + ".h5")).string();
  request.wall_limit = 120.0;
  return run_one(request);
}

bool same_states(const Trajectory& a, const Trajectory& b) {
  return a.frames.size() == b.frames.size() &&
         std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(),
                    [](const auto& x, const auto& y) { return state_hash(x) == state_hash(y); });
}

void check_result_file(const std::string& what, const fs::path& file, Checks& checks) {
  std::string text;
  try {
    text = text_of_regular_file(file.string(), std::uintmax_t{64} << 20);
  } catch (const InputError&) {  // no object then
  }
  const auto result =
      unfit_json(text).empty() ? nlohmann::json::parse(text, nullptr, false) : nlohmann::json();
  if (!checks.add(what + "result.json is one JSON object", result.is_object(), "it is not")) return;
  for (const char* key : {"contract", "status", "time_reached", "steps", "seconds", "readback"})
    checks.add(fmt::format("{}result.json has {}", what, key), result.contains(key), "it does not");
}

void check_metrics(const std::string& what, const Prepared& p, const Outcome& outcome, Checks& checks) {
  const auto metrics = evaluate_all(p.value, p.job, p.initial, *outcome.trajectory);
  for (const auto& gate : p.value.gates) {
    const auto& m = metrics.at(gate.metric);
    const bool near = std::abs(m.value) <= *gate.limit;  // false for NaN
    checks.add(fmt::format("{}its {} is in SI, near the exact one", what, gate.metric), near,
               fmt::format("error {:.3g} of at most {:g}; {}", m.value, *gate.limit, m.note));
  }
}

/// @return whether the engine took the scene
bool check_scene(const CheckScene& scene, const EngineEntry& engine, const fs::path& folder, Checks& checks) {
  const std::string what = scene.name + ": ";
  const auto p = prepare(scene, engine, folder);
  const auto outcome = run(scene, engine, p, folder, scene.name + "-1");
  if (outcome.status == Status::refused) {
    checks.add(what + "refused, with a reason", outcome.explained, "no reason");
    return false;
  }
  check_result_file(what, folder / (scene.name + "-1") / "result.json", checks);
  if (!checks.add(what + "runs to the end; times, ids, masses and read-back scene are those of the job",
                  outcome.status == Status::ok, fmt::format("{}: {}", outcome.status, outcome.reason)))
    return true;
  check_metrics(what, p, outcome, checks);
  if (!engine.deterministic) return true;
  const auto again = run(scene, engine, p, folder, scene.name + "-2");
  checks.add(what + "a second run has the same bits",
             again.trajectory && same_states(*outcome.trajectory, *again.trajectory),
             again.trajectory ? "it has not" : again.reason);
  return true;
}

/// Whether one of its capabilities begins with the word.
bool says_that_it_can(const EngineEntry& engine, const std::string& word) {
  return std::any_of(engine.capabilities.begin(), engine.capabilities.end(),
                     [&](const auto& c) { return c.rfind(word, 0) == 0; });
}

}  // namespace

std::vector<EngineCheck> check_engine(const std::string& executable) {
  Checks checks;
  if (!checks.add("is an executable file", fs::is_regular_file(executable), executable + " is none"))
    return checks.take();
  const ScratchFolder scratch;
  const auto engine = ask_engine(fs::absolute(executable).string());
  if (!check_info(engine, checks)) return checks.take();
  check_broken_jobs(engine.executable, scratch.path(), checks);
  int taken = 0;
  for (const auto& scene : check_scenes())
    if (scene.capability.empty() || says_that_it_can(engine, scene.capability))
      taken += check_scene(scene, engine, scratch.path(), checks);
  checks.add("it can do one scene of the check at least", taken > 0, "it refused them all");
  return checks.take();
}

}  // namespace tripoint
