// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "program/cli/case_summary.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/run_progress.hpp"
#include "sampling/sample.hpp"
#include "tables/units.hpp"
#include "validation/campaign/case_names.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/idle_keys.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/earlier_run.hpp"
#include "validation/run/finished_run.hpp"
#include "validation/run/run_one.hpp"
#include "validation/run/sandbox.hpp"
#include "validation/run/trial.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* run_description =
    "Runs one case on one engine, at the case's own resolution, and prints how it ended. Each metric is\n"
    "printed with its unit, its standard uncertainty and its limit. The exit code judges nothing:\n"
    "tripoint validate does.\n"
    "  tripoint run rigid/ballistic\n"
    "  tripoint run heat/cosine-mode --set scene.spacing='1 mm' --threads 2 --out coarse\n"
    "  tripoint run rigid/ballistic --engine bullet --until 0.5\n"
    "  tripoint run heat/cosine-mode --checkpoint-interval '10 s'; tripoint run heat/cosine-mode "
    "--resume runs/heat/cosine-mode/tripoint\n"
    "  tripoint run paper/fig-08-rigid --progress json --json --until 0.1   JSON lines on stderr\n"
    "DIR then holds job.json, particles.h5, trajectory.h5 (H5MD), trajectory.xdmf for ParaView,\n"
    "result.json and log.txt. Ctrl-C leaves a checkpoint there too. A run that goes on from it has the\n"
    "bits of an uncut one, on any number of threads.\n"
    "Exit: 0 done, 2 bad input, 4 the engine is missing, refuses, fails or does not answer, 7 diverged,\n"
    "130 Ctrl-C.";

struct RunOptions {
  std::string what, engine = engine_name::solver, out, until, resume, checkpoint_interval;
  std::vector<std::string> set;
  int threads = 1;
  double wall_limit = 1e9;
  std::string progress = "auto";
  bool quiet = false, json = false, sandbox = false;
};

/// The checkpoint itself, or the last one in a folder. @throws InputError
std::string checkpoint_file(const std::string& path) {
  if (fs::is_regular_file(path)) return fs::absolute(path).string();
  const auto found = checkpoints_in(path);
  if (found.empty())
    throw InputError(path +
                     ": is no checkpoint, nor a folder with one (a run leaves checkpoint-STEP.h5 with "
                     "--checkpoint-interval, and at Ctrl-C)");
  return fs::absolute(found.back()).string();
}

double seconds_of(const std::string& text) {
  try {
    char* end = nullptr;
    const double plain = std::strtod(text.c_str(), &end);
    const double value = *end == '\0' ? plain : parse_quantity(text, "s");
    if (value > 0.0 && std::isfinite(value)) return value;
  } catch (const std::invalid_argument& e) {
    throw InputError("--checkpoint-interval " + text + ": " + e.what());
  }
  throw InputError("--checkpoint-interval " + text + ": write a time above 0, for example '0.1 s'");
}

/// As the shell takes it back.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// How to go on with a run that Ctrl-C has stopped; empty where it left no checkpoint.
std::string way_on(const RunOptions& o) {
  const auto found = checkpoints_in(o.out);
  if (found.empty()) return "";
  std::string command = "tripoint run " + quoted(o.what);
  if (!is_own_solver(o.engine)) command += " --engine " + quoted(o.engine);
  for (const auto& set : o.set) command += " --set " + quoted(set);
  if (o.threads != 1) command += fmt::format(" --threads {}", o.threads);
  if (!o.checkpoint_interval.empty()) command += " --checkpoint-interval " + quoted(o.checkpoint_interval);
  return command + " --resume " + quoted(found.back());
}

int code_of(const RunOptions& o, const Outcome& outcome) {
  if (outcome.status == Status::ok) return exit_pass;
  if (outcome.status == Status::refused && !o.resume.empty())
    return exit_bad_input;  // it ran before: the checkpoint does not fit
  return outcome.status == Status::diverged ? exit_diverged : interrupted() ? exit_interrupted : exit_missing;
}

/// Limits that the case sets for the metric in this run; empty where it sets none.
std::string limits_of(const Case& value, const EnginePlan& plan, const RunPlan& run,
                      const std::string& metric, const MetricValue& m) {
  std::string text;
  for (const auto& g : value.gates) {
    const bool of_level = !g.level || std::any_of(run.levels.begin(), run.levels.end(), [&](const auto& l) {
      return same_level(l.second, *g.level);
    });
    const bool ours = (g.engine.empty() || g.engine == plan.name) && fits(g.mode, run.mode) &&
                      (g.preset.empty() || g.preset == plan.preset);
    if (g.metric != metric || !ours || !of_level) continue;
    const double size = std::abs(m.value) + 2.0 * m.uncertainty.combined();
    if (g.limit && *g.limit > 0.0 && size > *g.limit)
      text += fmt::format("  ABOVE the limit {:.4g}: {:.3g} times as much", *g.limit, size / *g.limit);
    else if (g.limit && *g.limit > 0.0)
      text += fmt::format("  limit {:.4g} ({:.3g} % of it)", *g.limit, 100.0 * size / *g.limit);
    else if (g.limit)
      text += fmt::format("  limit {:.4g}", *g.limit);  // a share of nothing is no number
    if (g.at_least)
      text += fmt::format("  {} {:.4g}", m.value < *g.at_least ? "BELOW the least" : "at least", *g.at_least);
    if (g.band) {
      const auto [low, high] = *g.band;
      text += fmt::format("  {} {:.4g} to {:.4g}",
                          m.value < low || m.value > high ? "OUTSIDE the band" : "band", low, high);
    }
  }
  return text;
}

/// In the order of the case file.
void print_metrics(const Case& value, const EnginePlan& plan,
                   const std::map<std::string, MetricValue>& metrics) {
  if (metrics.empty()) return;
  print(fmt::format("  {:26} {:>12} {:8} {:>9}\n", "metric", "value", "unit", "+- u"));
  for (const auto& choice : value.metrics) {
    const auto at = metrics.find(choice.name);
    if (at == metrics.end()) continue;
    const auto& m = at->second;
    print_line(fmt::format("  {:26} {:12.5g} {:8} {:9.2g}{}{}", choice.name, m.value, unit_of_value(choice),
                           m.uncertainty.combined(),
                           limits_of(value, plan, plan.runs.front(), choice.name, m),
                           m.note.empty() ? "" : "  (" + m.note + ")"));
  }
}

void print_text(const RunOptions& o, const Case& value, const EnginePlan& plan, const Outcome& outcome,
                const std::map<std::string, MetricValue>& metrics) {
  print_line(fmt::format("{}{}{}", outcome.status, outcome.reason.empty() ? "" : ": ", outcome.reason));
  const auto& r = outcome.result;
  if (r.steps > 0)
    print_line(fmt::format("  t = {:g} s in {} steps; last step {:g} s{}", r.time_reached, r.steps,
                           r.readback.time_step,
                           r.time_step_bound.empty() ? "" : ", bound by " + r.time_step_bound));
  print(fmt::format("  {:.3g} CPU s, {:.3g} s wall, {:.3g} MB memory\n", outcome.cost.cpu_s,
                    outcome.cost.wall_s, outcome.cost.peak_bytes / 1e6));
  print_metrics(value, plan, metrics);
  print_line(fmt::format("  in {}", o.out));
}

void print_json(const RunOptions& o, const Outcome& outcome,
                const std::map<std::string, MetricValue>& metrics) {
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (const auto& [name, m] : metrics) {
    values[name] = {
        {"value", std::isfinite(m.value) ? nlohmann::ordered_json(m.value) : nlohmann::ordered_json()},
        {"uncertainty", m.uncertainty.combined()},
        {"note", m.note}};
    if (!std::isfinite(m.value)) values[name]["finite"] = false;
  }
  const auto& r = outcome.result;
  print(json_text(nlohmann::ordered_json{{"status", outcome.status},
                                         {"reason", outcome.reason},
                                         {"time_reached", r.time_reached},
                                         {"steps", r.steps},
                                         {"time_step_bound", r.time_step_bound},
                                         {"state_hash", r.state_hash},
                                         {"cost",
                                          {{"cpu_s", outcome.cost.cpu_s},
                                           {"wall_s", outcome.cost.wall_s},
                                           {"peak_bytes", outcome.cost.peak_bytes}}},
                                         {"metrics", values},
                                         {"folder", o.out}},
                  2));
}

/// Says the findings of `check` about particles and metrics: a run of its own is not refused for them, but
/// not silent either.
void say_findings(const CaseReading& reading, const Scene& scene, const InitialState& initial,
                  const Job& job) {
  for (const auto& f : library_values(reading)) say("note: " + with_place(f));
  for (const auto& f : old_keys(reading)) say("note: " + with_place(f));
  for (const auto& f : start_notes(scene, initial)) say("note: " + with_place(f));
  for (const auto& f : foreseen(scene)) say("note: " + with_place(f));
  auto findings = preflight(reading.value, scene, initial);
  for (auto& f : idle_keys(reading, scene, initial)) findings.push_back(std::move(f));
  for (auto& f : try_metrics(reading.value, job, initial)) findings.push_back(std::move(f));
  for (const auto& f : findings) say((f.error ? "error, run all the same: " : "warning: ") + with_place(f));
}

/// The engine's base run in the case's first mode.
EnginePlan plan_for(const Case& value, const std::vector<EngineEntry>& engines, const std::string& name) {
  Selection selection;
  selection.engines = {name};
  auto plan = plan_runs(value, engines, selection).front();
  if (!plan.entry) throw EngineError(no_such_engine(name, engines));
  if (!plan.entry->available) throw EngineError(name + " is not available: " + plan.entry->reason);
  return plan;
}

/// Fills in options that the command leaves open: where the run goes on, and its folder.
void fill_in(RunOptions& o, const Case& value) {
  if (!o.resume.empty()) o.resume = checkpoint_file(o.resume);
  if (o.out.empty() && !o.resume.empty()) o.out = fs::path(o.resume).parent_path().string();
  if (o.out.empty()) o.out = "runs/" + value.id + "/" + o.engine.substr(o.engine.rfind('/') + 1);
}

bool goes_on_in(const RunOptions& o) {
  std::error_code none;
  return !o.resume.empty() && fs::equivalent(fs::path(o.resume).parent_path(), o.out, none);
}

/// Runs the job in its folder, and shows how far it is. A run that does not begin leaves the one that was
/// there.
Outcome run_shown(const EnginePlan& plan, const Job& job, const InitialState& initial, const RunOptions& o) {
  RunRequest request;
  request.engine = plan.entry;
  request.job = &job;
  request.initial = &initial;
  request.wall_limit = o.wall_limit;
  request.folder = fs::absolute(o.out).string();
  request.particles = (fs::absolute(o.out) / "particles.h5").string();
  EarlierRun earlier(o.out, goes_on_in(o));
  const auto let_go_of_earlier = [&] {
    if (earlier.is_replaced()) earlier.let_go();
  };
  write_particles(request.particles, initial);
  if (!o.quiet)
    say(fmt::format("{} on {} {}: {} particles to t = {:g} s", job.case_id, plan.name, plan.entry->version,
                    initial.size(), job.scene.end_time));
  RunProgress progress(progress_form(o.progress, o.quiet, isatty(2) == 1));
  request.progress = [&](double done) {
    let_go_of_earlier();
    progress.at(done);
  };
  request.status = [&](const std::string& status) { progress.at(status); };
  if (const auto seconds = progress.interval(); !seconds.empty())
    request.environment["TRIPOINT_STATUS"] = seconds;
  auto outcome = run_one(request);
  progress.end();
  if (outcome.status != Status::refused) let_go_of_earlier();
  return outcome;
}

int run(RunOptions o) {
  catch_interrupts();
  if (!o.until.empty()) o.set.push_back("scene.end_time=" + o.until);
  const CaseReading reading = read_case(shown_path(case_file(o.what)), o.set);
  const Case& value = reading.value;
  fill_in(o, value);
  const auto words = sort_engine_words(files_as_paths({o.engine}));
  if (o.sandbox) sandbox_third_parties(o.out);
  const auto engines = discover_engines(words.paths);
  const auto plan =
      plan_for(value, engines, words.paths.empty() ? o.engine : ask_engine(words.paths.front()).name);
  const Scene scene = scene_of(value, plan.runs.front());
  const auto lock = hold_folder(o.out);
  if (scene.settle && !o.quiet)
    say("letting the liquids down into equilibrium, which takes as long as some thousand steps "
        "(scene.settle)");
  const auto initial = sample(scene);
  auto job = make_job(value, plan, plan.runs.front(), scene, initial);
  if (!o.quiet) say_findings(reading, scene, initial, job);
  job.threads = o.threads;
  job.resume = o.resume;
  if (!o.checkpoint_interval.empty()) job.settings["checkpoint_interval"] = seconds_of(o.checkpoint_interval);
  const auto outcome = run_shown(plan, job, initial, o);
  std::map<std::string, MetricValue> metrics;
  if (outcome.trajectory) metrics = evaluate_all(value, job, initial, *outcome.trajectory);
  if (o.json)
    print_json(o, outcome, metrics);
  else
    print_text(o, value, plan, outcome, metrics);
  if (const auto command = interrupted() ? way_on(o) : ""; !command.empty()) say("go on with: " + command);
  return code_of(o, outcome);
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", run_description);
  auto o = std::make_shared<RunOptions>();
  command->add_option("CASE", o->what, "a case file or id")->required();
  command->add_option("--engine", o->engine, "name of an engine, or path of an executable")
      ->capture_default_str();
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--out", o->out, "folder of the run (default: runs/CASE/ENGINE)");
  command->add_option("--threads", o->threads, "threads of the engine; they do not change its bits")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--set", o->set, "a.b=VALUE replaces a key of the case file; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--until", o->until, "end at this time instead: seconds, or a number with a unit");
  command
      ->add_option("--resume", o->resume,
                   "go on from this checkpoint, or from the last in this folder; writes there unless --out "
                   "says otherwise")
      ->type_name("CHECKPOINT");
  command->add_option(
      "--checkpoint-interval", o->checkpoint_interval,
      "simulated time between checkpoints: seconds, or a number with a unit; the last two are kept");
  command
      ->add_option("--progress", o->progress,
                   "on stderr: auto (one line on a terminal), lines, json (one object a line) or none")
      ->check(CLI::IsMember({"auto", "lines", "json", "none"}))
      ->capture_default_str();
  command->add_flag("--quiet", o->quiet, "no progress and no notes on stderr");
  command->add_flag("--json", o->json, "print one JSON document");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return run(*o); }); });
}

}  // namespace tripoint
