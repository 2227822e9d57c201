// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/merge.hpp"
#include "program/cli/options.hpp"
#include "validation/baseline/history.hpp"
#include "validation/case/case.hpp"
#include "validation/judge/judge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/queue/cost.hpp"
#include "validation/queue/emit.hpp"
#include "validation/queue/join.hpp"
#include "validation/queue/make_queue.hpp"
#include "validation/queue/shards.hpp"
#include "validation/queue/status.hpp"
#include "validation/queue/work.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* suite_description =
    "Makes a suite by many processes or machines that share a folder. A job is one run of one engine, and\n"
    "any worker takes it. The merged report is the one that `tripoint validate` would have written.\n"
    "  tripoint suite make DIR --profile nightly      plan the jobs; nothing runs\n"
    "  tripoint suite work DIR                        take jobs until all are done; start it as "
    "often as you like\n"
    "  tripoint status DIR                            done, running, lost, failed, and the time "
    "that is left\n"
    "  tripoint merge DIR                             judge, and write DIR/index.html\n"
    "  tripoint suite emit DIR --for slurm            a script that does it on a scheduler\n"
    "A killed worker loses only its present job; the next `work` takes it over. docs/scale.md says more.";

constexpr const char* make_description =
    "Plans every run of the cases as a job in DIR, with a predicted cost; nothing runs. The id of a job\n"
    "is a hash of its scene, particles, engine, version, level and seed. Made again after a change, the\n"
    "suite keeps the results that still hold.\n"
    "  tripoint suite make DIR                                    the commit suite\n"
    "  tripoint suite make DIR heat rigid/ballistic --engines tripoint,bullet\n"
    "  tripoint suite make DIR --profile nightly --costs report/results.json    shares work out by "
    "earlier costs";

constexpr const char* work_description =
    "Takes jobs of the suite until all are finished. Ctrl-C gives its jobs back.\n"
    "  tripoint suite work DIR                  any job that waits, the dearest first\n"
    "  tripoint suite work DIR --jobs 4         four engine processes at a time\n"
    "  tripoint suite work DIR --shard 2/8      the second of eight shards of equal predicted cost\n"
    "Jobs that other workers hold are waited for. Jobs of a lost worker are taken over: on this machine\n"
    "at once, on another after 60 s without a sign.\n"
    "Exit: 0 every wanted job has a result, whatever it says, 2 a case, an engine or the program has\n"
    "changed since the suite was made, 4 others hold jobs (--no-wait alone), 130 Ctrl-C.";

constexpr const char* status_description =
    "Says where a suite stands: jobs that are done, running, waiting, lost, failed, doubled, and the time\n"
    "that is left.\n"
    "  tripoint status DIR\n"
    "  tripoint status DIR --json\n"
    "Lost: its worker is gone; the next `tripoint suite work DIR` makes that job again, and no other.\n"
    "Failed: killed, timed out or ended with an error; `tripoint suite retry DIR` puts it back. Doubled:\n"
    "two workers made it; the first result counts. The time left is a prediction.";

constexpr const char* retry_description =
    "Puts failed jobs back to those that wait: all of them, or those whose ids are given.\n"
    "  tripoint suite retry DIR\n"
    "  tripoint suite retry DIR 1b6f0c55a1e2d3f4";

constexpr const char* emit_description =
    "Prints a script that makes the suite on a scheduler. Short jobs are batched: a task takes a shard of\n"
    "about --batch seconds.\n"
    "  tripoint suite emit DIR --for slurm > suite.sh                       sbatch suite.sh\n"
    "  tripoint suite emit DIR --for parallel --batch 60 > suite.sh         JOBS=8 bash suite.sh\n"
    "  tripoint suite emit DIR --for snakemake --shards 16 > Snakefile      snakemake --cores 2\n"
    "  tripoint suite emit DIR --for slurm --shards 16 --left > again.sh    only the shards that "
    "are not finished";

struct MakeOptions {
  std::string dir, costs;
  EngineList engines;
  Queue queue;
  bool sandbox = false;
};

/// The suite of a folder, and its folder's path from anywhere. Goes to the working folder in which the suite
/// was made: there every path is the same text.
struct Opened {
  std::string typed, dir;
  Queue queue;
};

Opened open(const std::string& typed) {
  Opened o{typed, fs::absolute(typed).lexically_normal().string(), read_queue(typed)};
  while (o.dir.size() > 1 && o.dir.back() == '/') o.dir.pop_back();
  return o;
}

void go_to_its_folder(const Opened& o) {
  std::error_code none;
  // Not there on a machine with other folders: then paths must not matter
  fs::current_path(o.queue.folder, none);
}

/// The engines of these jobs and no other: to ask each engine takes longer than many a job.
std::vector<EngineEntry> engines_of(const Queue& queue, const std::vector<std::size_t>& rows) {
  std::set<std::string> names;
  for (const auto row : rows) names.insert(queue.jobs[row].engine);
  std::vector<EngineEntry> engines;
  for (const auto& path : sort_engine_words(queue.engine_words).paths) engines.push_back(ask_engine(path));
  for (const auto& e : engines) names.erase(e.name);
  for (auto& e : discover_engines_named({names.begin(), names.end()})) engines.push_back(std::move(e));
  return engines;
}

int make(MakeOptions o) {
  auto& queue = o.queue;
  if (queue.filter.what.empty() && queue.filter.profile.empty()) queue.filter.profile = "commit";
  queue.folder = fs::current_path().string();
  queue.command = command_line();
  queue.engine_words = o.engines.words();
  const auto cases = select_cases(queue.filter);
  if (o.sandbox) sandbox_third_parties(o.dir);
  const auto engines = engines_asked_for(queue.engine_words, queue.selection);
  std::map<std::string, double> costs;
  if (!o.costs.empty()) costs = measured_costs(read_results(results_file(o.costs)));
  make_folder(o.dir);
  if (fs::exists(fs::path(o.dir) / "suite.json")) {
    const Queue before = read_queue(o.dir);
    say(fmt::format("{}: was a suite of {} jobs of {} cases, and is made anew", o.dir, before.jobs.size(),
                    before.cases.size()));
  }
  const auto made = make_queue(o.dir, std::move(queue), cases, engines, costs);
  const auto& jobs = made.queue.jobs;
  print_line(fmt::format(
      "{}: {} jobs of {} cases, {:.0f} CPU s predicted ({} by what they cost before); {} have a result",
      o.dir, jobs.size(), cases.size(), cost_of(jobs, dearest_first(jobs)), made.measured, made.kept));
  say(fmt::format(
      "next: tripoint suite work {}   or a script for a scheduler: tripoint suite emit {} --for slurm", o.dir,
      o.dir));
  return exit_pass;
}

int run_worker(const std::string& typed, const std::string& shard, WorkOptions o, bool sandbox) {
  catch_interrupts();
  const auto opened = open(typed);
  const auto& jobs = opened.queue.jobs;
  const auto part = shard.empty() ? Shard{1, 1} : read_shard(shard);
  o.rows = balanced_shards(jobs, part.n)[static_cast<std::size_t>(part.i - 1)];
  o.say = [](const std::string& line) { say(line); };
  const auto start = std::chrono::steady_clock::now();
  go_to_its_folder(opened);
  if (sandbox) sandbox_third_parties(opened.dir, o.jobs);
  const auto done = work(opened.dir, opened.queue, engines_of(opened.queue, o.rows), o);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print_line(fmt::format(
      "{}: {} of {} jobs made here in {:.1f} s, {} of them failed, {} taken over; {} are not finished", typed,
      done.made, o.rows.size(), seconds, done.failed, done.taken_over, done.held_by_others));
  if (interrupted()) return exit_interrupted;
  return done.held_by_others > 0 ? exit_missing : exit_pass;
}

int status(const std::string& dir, bool json) {
  const auto opened = open(dir);
  const auto status = status_of(opened.dir, opened.queue);
  print(json ? status_json(opened.dir, opened.queue, status) : status_text(dir, opened.queue, status));
  return exit_pass;
}

int retry(const std::string& dir, const std::vector<std::string>& ids) {
  const auto opened = open(dir);
  print_line(fmt::format("{}: {} jobs wait again", dir, retry_failed(opened.dir, opened.queue, ids)));
  return exit_pass;
}

struct EmitChoice {
  std::string dir, scheduler;
  int shards = 0, most = 1000;
  double batch = 600.0;
  bool left = false;
};

/// Shards with a job that has no result, from 1.
std::vector<int> shards_left(const Opened& opened, const std::vector<std::vector<std::size_t>>& shards,
                             bool only_left) {
  const auto standing = look(opened.dir, opened.queue);
  const auto is_open = [&](std::size_t row) {
    return standing.jobs[row].stand != Stand::done && standing.jobs[row].stand != Stand::failed;
  };
  std::vector<int> numbers;
  for (std::size_t k = 0; k < shards.size(); ++k)
    if (!only_left || std::any_of(shards[k].begin(), shards[k].end(), is_open))
      numbers.push_back(static_cast<int>(k) + 1);
  return numbers;
}

int emit(const EmitChoice& o) {
  const auto opened = open(o.dir);
  const auto& jobs = opened.queue.jobs;
  EmitOptions options;
  options.program = (fs::path(program_folder()) / "tripoint").string();
  options.dir = opened.dir;
  options.typed = o.dir;
  options.shards = o.shards > 0 ? o.shards : shards_of_seconds(jobs, o.batch, o.most);
  const auto shards = balanced_shards(jobs, options.shards);
  for (const auto& rows : shards) options.longest = std::max(options.longest, cost_of(jobs, rows));
  options.numbers = shards_left(opened, shards, o.left);
  if (options.numbers.empty()) throw InputError(o.dir + ": every shard is finished: tripoint merge " + o.dir);
  print(script_for(o.scheduler, opened.queue, options));
  return exit_pass;
}

void add_make(CLI::App& suite, int& exit_code) {
  auto* command = suite.add_subcommand("make", make_description);
  auto o = std::make_shared<MakeOptions>();
  auto& queue = o->queue;
  command->add_option("DIR", o->dir, "folder of the suite")->required();
  command->add_option("CASE", queue.filter.what, "case files, folders of them, or ids")
      ->type_name("CASE|DIR");
  command
      ->add_option("--profile", queue.filter.profile,
                   "only cases of this profile (commit where no CASE is given)")
      ->check(CLI::IsMember({"commit", "nightly", "release"}));
  command->add_option("--tag", queue.filter.tag, "only cases with this tag");
  command->add_option("-k", queue.filter.substring, "only cases with this in their id")
      ->type_name("SUBSTRING");
  add_engines_option(*command, o->engines);
  add_sandbox_flag(*command, o->sandbox);
  command->add_option_function<std::uint64_t>(
      "--seed", [o](std::uint64_t seed) { o->queue.selection.seed = seed; }, "replaces the cases' seeds");
  command->add_option("--threads", queue.threads, "threads of each engine process")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--time-limit", queue.wall_limit,
                   "seconds for one run; engine setting wall_limit goes before it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--costs", o->costs,
                   "a results.json, or its folder: its measured costs replace predictions")
      ->type_name("RESULTS");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return make(*o); }); });
}

void add_work(CLI::App& suite, int& exit_code) {
  auto* command = suite.add_subcommand("work", work_description);
  auto dir = std::make_shared<std::string>(), shard = std::make_shared<std::string>();
  auto o = std::make_shared<WorkOptions>();
  command->add_option("DIR", *dir, "folder of the suite")->required();
  auto sandbox = std::make_shared<bool>(false);
  add_sandbox_flag(*command, *sandbox);
  command->add_option("--shard", *shard, "k/n: the jobs of the k-th of n shards alone");
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag_callback(
      "--no-wait", [o] { o->waits = false; },
      "leave when nothing is to be taken, though others are still at their jobs");
  command->callback(
      [=, &exit_code] { exit_code = guarded([&] { return run_worker(*dir, *shard, *o, *sandbox); }); });
}

void add_status_to(CLI::App& app, int& exit_code, const std::string& earlier) {
  auto* command = app.add_subcommand("status", status_description);
  if (!earlier.empty()) command->group("");
  auto dir = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  command->add_option("DIR", *dir, "folder of the suite")->required();
  command->add_flag("--json", *json,
                    "one JSON document on stdout, with every job that is running, lost, failed or doubled");
  command->callback([=, &exit_code] {
    if (!earlier.empty()) note_earlier(earlier, "tripoint status");
    exit_code = guarded([&] { return status(*dir, *json); });
  });
}

void add_retry(CLI::App& suite, int& exit_code) {
  auto* command = suite.add_subcommand("retry", retry_description);
  auto dir = std::make_shared<std::string>();
  auto ids = std::make_shared<std::vector<std::string>>();
  command->add_option("DIR", *dir, "folder of the suite")->required();
  command->add_option("ID", *ids, "jobs; none = all that failed");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return retry(*dir, *ids); }); });
}

void add_emit(CLI::App& suite, int& exit_code) {
  auto* command = suite.add_subcommand("emit", emit_description);
  auto o = std::make_shared<EmitChoice>();
  command->add_option("DIR", o->dir, "folder of the suite")->required();
  command->add_option("--for", o->scheduler, "the scheduler")->required()->check(CLI::IsMember(schedulers()));
  command->add_option("--batch", o->batch, "predicted CPU seconds of a task")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--shards", o->shards, "tasks, in the place of --batch")->check(CLI::Range(1, 100000));
  command->add_option("--most", o->most, "tasks at most, as sites limit arrays")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--left", o->left, "only shards with jobs that have no result");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return emit(*o); }); });
}

}  // namespace

int merge_suite(const std::string& typed, const MergeOptions& o) {
  const auto opened = open(typed);
  const auto folder = o.out.empty() ? opened.dir : fs::absolute(o.out).lexically_normal().string();
  const auto lock = hold_folder(folder);
  if (o.sandbox) sandbox_third_parties(folder);
  set_aside_report(folder);
  std::function<void(const CaseResult&)> on_case;
  if (!o.json) on_case = [](const CaseResult& c) { print(case_line(c) + "\n"); };
  const auto start = fs::current_path();
  go_to_its_folder(opened);
  auto results =
      join(opened.dir, opened.queue,
           discover_selected(opened.queue.selection, sort_engine_words(opened.queue.engine_words).paths),
           folder, on_case);
  fs::current_path(start);
  results.command = command_line();
  results.date = date_now();
  results.history = "history.jsonl";
  judge(results);
  append_history((fs::path(folder) / results.history).string(), history_lines(results));
  if (!o.page)
    write_results(results, folder);
  else if (const auto missing = write_report(results, folder); !missing.empty())
    say("tripoint: no page: " + missing);
  if (!o.json) print(notes_text(results));
  print(o.json ? results_text(results) : last_line(results, o.out.empty() ? typed : o.out) + "\n");
  return results.exit_code;
}

void add_suite(CLI::App& app, int& exit_code) {
  auto* suite = app.add_subcommand("suite", suite_description);
  list_when_alone(*suite, exit_code);
  for (const auto add : {add_make, add_work, add_retry, add_emit}) add(*suite, exit_code);
  add_merge_to(*suite, exit_code, "tripoint suite merge");
  add_status_to(*suite, exit_code, "tripoint suite status");
}

void add_status(CLI::App& app, int& exit_code) { add_status_to(app, exit_code, ""); }

}  // namespace tripoint
