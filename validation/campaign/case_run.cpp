// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/case_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sampling/sample.hpp"
#include "validation/campaign/invariance.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/judge.hpp"
#include "validation/references/experiment.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/run/finished_run.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// Samples each scene of a case once; runs of one sampling share state and file.
class Sampler {
 public:
  Sampler(fs::path folder, const SuiteOptions& options) : folder_(std::move(folder)), options_(options) {}
  struct Sample {
    std::shared_ptr<const InitialState> state;
    std::string file;
    std::shared_ptr<std::string> hash;
  };
  const Sample& of(const Scene& scene) {
    const auto key = sampling_key(scene);
    const auto at = samples_.find(key);
    return at != samples_.end() ? at->second : (samples_[key] = make(scene, key));
  }

 private:
  Sample make(const Scene& scene, const std::string& key) {
    const std::string file = (folder_ / (key + ".h5")).string();
    const Sample made{state_of(scene, file), file, std::make_shared<std::string>()};
    if (options_.plans_alone || (options_.made && options_.are_all_made && fs::exists(made.file)))
      return made;
    fs::create_directories(folder_);
    const std::lock_guard lock(no_spawn_mutex());  // Debian's HDF5 is not thread-safe either
    fs::remove(made.file);
    write_particles(made.file, *made.state);
    *made.hash = file_hash(made.file);
    return made;
  }
  std::shared_ptr<const InitialState> state_of(const Scene& scene, const std::string& file) const {
    if (!options_.settled || !scene.settle) return std::make_shared<InitialState>(sample(scene));
    auto& kept = (*options_.settled)[file];
    if (!kept) kept = std::make_shared<InitialState>(sample(scene));
    return kept;
  }
  fs::path folder_;
  const SuiteOptions& options_;
  std::map<std::string, Sample> samples_;
};

double wall_limit(const EnginePlan& engine, const SuiteOptions& options) {
  const auto at = engine.settings.find("wall_limit");
  return at != engine.settings.end() && std::holds_alternative<double>(at->second)
             ? std::get<double>(at->second)
             : options.wall_limit;
}

Knobs knobs_of(const CaseRun& run, const Result& result) {
  const auto& r = run.job.resolution;
  return {r.spacing,
          result.readback.time_step > 0.0 ? result.readback.time_step : r.time_step.value_or(0.0),
          r.support_ratio,
          r.walkers,
          r.iterations,
          run.plan.mode,
          run.job.threads,
          run.job.seed,
          run.job.scene.jitter};
}

EngineRow row_of(const EnginePlan& plan) {
  EngineRow row;
  row.name = plan.name;
  row.preset = plan.preset;
  row.required = plan.required;
  row.refuses = declared_refusal(plan.settings);
  if (plan.entry) {
    row.version = plan.entry->version;
    row.library_path = plan.entry->library_path;
    row.library_hash = plan.entry->library_hash;
    row.deterministic = plan.entry->deterministic;
    if (plan.entry->available && !belongs_to_us(plan.entry->executable)) {
      row.executable = shown_path(plan.entry->executable);
      row.executable_hash = program_hash(plan.entry->executable);
    }
  }
  if (!plan.entry) {
    row.status = Status::missing;
    row.reason =
        fmt::format("there is no engine-{} beside the program or in TRIPOINT_ENGINE_PATH", plan.name);
  } else if (!plan.entry->available) {
    row.status = Status::missing;
    row.reason = plan.entry->reason;
  }
  return row;
}

std::string repeat_command(const Case& value, const SuiteOptions& options) {
  std::string command = "tripoint validate " + value.file;
  const auto& asked = options.selection.asked;
  if (!asked.empty())
    command += fmt::format(" --engines {}{}", options.selection.engines.empty() ? "all," : "",
                           fmt::join(asked, ","));
  if (options.selection.seed) command += fmt::format(" --seed {}", *options.selection.seed);
  return command;
}

/// @param number of the run: runs of one start have files of their own, since HDF5 writes the second of the
/// day into each
std::shared_ptr<const ChangedRun> changed_run(const Case& value, const EnginePlan& engine, const CaseRun& run,
                                              const InvarianceChange& change, std::size_t number) {
  ChangedScene changed{run.job.scene, *run.initial, run.job.threads};
  change.apply(changed);
  auto made = std::make_shared<ChangedRun>();
  made->job = make_job(value, engine, run.plan, changed.scene, changed.initial);
  made->job.threads = changed.threads;
  made->particles =
      fs::path(run.particles).replace_extension(fmt::format("{}-{}.h5", change.name, number)).string();
  made->initial = std::move(changed.initial);
  const std::lock_guard lock(no_spawn_mutex());
  fs::remove(made->particles);
  write_particles(made->particles, made->initial);
  made->particles_hash = std::make_shared<std::string>(file_hash(made->particles));
  return made;
}

/// The frames as the unchanged scene would have made them.
std::shared_ptr<const Trajectory> taken_back(const CaseRun& run, const InvarianceChange& change,
                                             const Trajectory& frames) {
  auto back = std::make_shared<Trajectory>(frames);
  change.take_back({run.job.scene, *run.initial, run.job.threads}, *back);
  return back;
}

bool is_wanted(const EnginePlan& engine, const RunPlan& plan, const SuiteOptions& options) {
  return !options.wanted || options.wanted(engine, plan);
}

}  // namespace

CaseRuns plan_case(const Case& value, const std::vector<EngineEntry>& found, const SuiteOptions& options) {
  check_data_files(value);
  CaseRuns all;
  all.value = &value;
  all.hashes = case_hashes(value.file);
  all.engines = plan_runs(value, found, options.selection);
  return all;
}

std::size_t number_of_runs(const CaseRuns& all, const SuiteOptions& options) {
  std::size_t n = 0;
  for (const auto& engine : all.engines)
    if (engine.entry)
      n += static_cast<std::size_t>(std::ranges::count_if(
          engine.runs, [&](const RunPlan& plan) { return is_wanted(engine, plan, options); }));
  return n;
}

CaseRuns prepare_case(const Case& value, const std::vector<EngineEntry>& found, const SuiteOptions& options) {
  auto all = plan_case(value, found, options);
  add_runs(all, options);
  return all;
}

void add_runs(CaseRuns& all, const SuiteOptions& options) {
  const Case& value = *all.value;
  const fs::path folder = fs::path(options.out) / "runs" / value.id;
  Sampler sampler(folder / "particles", options);
  for (std::size_t e = 0; e < all.engines.size(); ++e) {
    const auto& engine = all.engines[e];
    if (!engine.entry) continue;
    for (const auto& plan : engine.runs) {
      if (!is_wanted(engine, plan, options)) continue;
      if (interrupted()) return;  // a thousand seeds are sampled for minutes
      CaseRun run;
      const Scene scene = scene_of(value, plan);
      const auto& [initial, file, hash] = sampler.of(scene);
      run.engine = e;
      run.plan = plan;
      run.initial = initial;
      run.particles = file;
      run.particles_hash = hash;
      run.job = make_job(value, engine, plan, scene, *initial);
      run.job.threads = options.threads;
      if (options.change) run.changed = changed_run(value, engine, run, *options.change, all.runs.size());
      run.folder = (folder / engine.name / run_folder_name(engine.preset, plan.label)).string();
      all.runs.push_back(std::move(run));
    }
  }
}

namespace {

RunRequest request_of(const CaseRuns& all, const CaseRun& run, const SuiteOptions& options) {
  const auto& engine = all.engines[run.engine];
  RunRequest request;
  request.engine = engine.entry;
  request.job = &run.job;
  request.initial = run.initial.get();
  if (run.changed) {
    request.job = &run.changed->job;
    request.initial = &run.changed->initial;
  }
  request.folder = fs::absolute(run.folder).string();
  request.particles = fs::absolute(run.changed ? run.changed->particles : run.particles).string();
  request.particles_hash = run.changed ? run.changed->particles_hash : run.particles_hash;
  request.wall_limit = wall_limit(engine, options);
  request.environment = options.environment;
  request.before_third_party = options.before_third_party;
  request.keep_finished = options.resume;
  request.count_below = options.count_below;
  return request;
}

/// Facts that the harness itself knows of a run, before any engine has spoken.
void describe_run(CaseRun& run, const Result& result, const SuiteOptions& options) {
  auto& row = run.row;
  row.knobs = knobs_of(run, result);
  row.levels = run.plan.levels;
  row.base = run.plan.base;
  row.group = run.plan.group;
  row.input = run.plan.input;
  row.folder = fs::relative(run.folder, options.out).string();
}

/// Whether compare_engines() can come to look at the frames of the run: it compares two engines, and never
/// the exact one.
bool is_compared(const CaseRuns& all, const CaseRun& run) {
  const auto counts = [&](const CaseRun& r) { return r.plan.base && !is_exact(all.engines[r.engine].name); };
  return counts(run) &&
         std::ranges::any_of(all.runs, [&](const CaseRun& r) { return counts(r) && r.engine != run.engine; });
}

/// Whether the run is made twice: the case was adopted for this engine, which says that it is deterministic.
bool is_repeated(const CaseRuns& all, const CaseRun& run) {
  const auto& engine = all.engines[run.engine];
  const bool adopted = std::ranges::any_of(all.value->engines,
                                           [&](const auto& e) { return e.adopted && e.name == engine.name; });
  return adopted && run.plan.base && !run.kept && run.row.status == Status::ok &&
         engine.entry->deterministic && !belongs_to_us(engine.entry->executable);
}

/// What a repeat of the run gives otherwise; empty = nothing.
std::string difference_of_repeat(const CaseRuns& all, const CaseRun& run, const SuiteOptions& options) {
  auto request = request_of(all, run, options);
  request.folder += "-repeat";
  request.keep_finished = false;
  request.count_below = 0.0;
  const auto again = run_one(request);
  std::error_code none;
  fs::remove_all(request.folder, none);
  if (interrupted()) return {};
  if (!again.trajectory) return fmt::format("its repeat is {}", again.status);
  for (const auto& [name, value] : evaluate_all(*all.value, run.job, *run.initial, *again.trajectory)) {
    const auto first = run.row.metrics.find(name);
    if (first != run.row.metrics.end() && first->second.value != value.value && std::isfinite(value.value))
      return fmt::format("{} is {:.9g} in one run and {:.9g} in its repeat", name, first->second.value,
                         value.value);
  }
  return {};
}

/// A run that somebody else has made. Its frames are read where engines are compared by them.
void take_made(const CaseRuns& all, CaseRun& run, MadeRun made, const SuiteOptions& options) {
  run.row = std::move(made.row);
  run.ledger = std::move(made.ledger);
  run.kept = run.taken = true;
  if (run.row.status != Status::ok || !is_compared(all, run)) return;
  ProcessEnd end;
  end.how = ProcessEnd::How::exited;
  const auto outcome = read_back(request_of(all, run, options), end);
  if (outcome.status != Status::ok) {
    run.row.status = Status::error;
    run.row.reason = "its frames are not as it left them: " + outcome.reason;
  }
  run.trajectory = outcome.trajectory;
}

}  // namespace

std::string run_id(const CaseRuns& all, const CaseRun& run, const SuiteOptions& options) {
  const auto& engine = all.engines[run.engine];
  std::string text = hash_of(request_of(all, run, options));
  for (const auto& part : {all.value->id, engine.name, engine.preset, run.plan.label}) text += '\0' + part;
  return text_hash(text);
}

void give_up(CaseRun& run, Status status, const std::string& reason, const SuiteOptions& options) {
  describe_run(run, {}, options);
  run.row.status = status;
  run.row.reason = reason;
}

void make_run(const CaseRuns& all, CaseRun& run, const SuiteOptions& options) {
  if (auto made = options.made ? options.made(all, run) : std::nullopt)
    return take_made(all, run, std::move(*made), options);
  auto outcome = run_one(request_of(all, run, options));
  if (run.changed && outcome.trajectory)
    outcome.trajectory = taken_back(run, *options.change, *outcome.trajectory);
  run.kept = outcome.kept;
  describe_run(run, outcome.result, options);
  auto& row = run.row;
  row.status = outcome.status;
  row.reason = outcome.reason;
  row.comparable = outcome.comparable;
  row.cost = outcome.cost;
  row.state_hash = outcome.result.state_hash;
  row.time_step_bound = outcome.result.time_step_bound;
  if (outcome.trajectory) row.metrics = evaluate_all(*all.value, run.job, *run.initial, *outcome.trajectory);
  if (is_repeated(all, run))
    if (const auto how = difference_of_repeat(all, run, options); !how.empty())
      row.reason = untrue_flag + (": " + how);
  if (!run.plan.base || !outcome.trajectory) return;
  run.trajectory = outcome.trajectory;
  if (is_own_solver(all.engines[run.engine].name)) run.ledger = ledger_of(*run.trajectory);
}

CaseResult finish_case(const CaseRuns& all, const SuiteOptions& options) {
  const auto& value = *all.value;
  CaseResult result;
  result.id = value.id;
  result.title = value.title;
  result.kind = value.kind;
  result.requirement = value.requirement;
  result.claims = value.claims;
  result.file = value.file;
  result.expect = value.expect;
  result.reference = with_source_of_file(value.reference);
  result.tags = value.tags;
  result.metrics = value.metrics;
  result.studies = value.studies;
  result.gates = value.gates;
  for (const auto& e : value.engines)
    if (e.adopted) result.adopted.push_back(e.name);
  result.hashes = all.hashes;
  result.repeat = repeat_command(value, options);
  for (std::size_t e = 0; e < all.engines.size(); ++e) {
    auto row = row_of(all.engines[e]);
    for (const auto& run : all.runs)
      if (run.engine == e) row.runs.push_back(run.row);
    result.engines.push_back(std::move(row));
  }
  result.equivalence = compare_engines(all);
  for (const auto& run : all.runs)
    if (result.ledger.empty()) result.ledger = run.ledger;
  judge(result, !options.selection.engines.empty());
  return result;
}

}  // namespace tripoint
