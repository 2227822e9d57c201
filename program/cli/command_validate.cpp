// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/options.hpp"
#include "validation/baseline/history.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/campaign/timing.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/judge/judge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/publish/scorecard.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"
#include "validation/run/trial.hpp"

namespace tripoint {
namespace {

struct ValidateOptions {
  CaseFilter filter;
  SuiteOptions suite;
  std::string profile, shard, history;
  EngineList engines;
  bool keep_history = true;
  int timing = 0;
  std::uint64_t seed = 0;
  bool seed_given = false, json = false, page = true, last_failed = false, sandbox = false;
};

constexpr const char* validate_description =
    "Runs cases on their engines, compares each with its reference, judges every gate and writes the\n"
    "report.\n\n"
    "Without CASE it takes the cases beside the program that belong to the profile.\n"
    "  tripoint validate                                     the commit suite\n"
    "  tripoint validate heat/cosine-mode --jobs 2           one case, two engine processes at a time\n"
    "  tripoint validate heat                                the cases of one subject, from any folder\n"
    "  tripoint validate -k floating                         the cases with this in their id\n"
    "  tripoint validate my-cases/ --engines all,./my-engine   your cases, with your engine beside ours\n"
    "  tripoint validate --profile acceptance --engines all,./my-engine   a scorecard of your engine\n"
    "  tripoint validate --last-failed --no-report           the cases that were not green, quickly\n"
    "  tripoint validate --resume                            the rest of an earlier call that was cut\n"
    "  tripoint validate --profile nightly --shard 1/4       a quarter of the suite; tripoint merge "
    "joins the four\n"
    "The verdict is the last line; OUT/index.html shows it, OUT/results.json holds it.";

/// Ids of the cases that were not green in the results that OUT holds. @throws InputError where there are
/// none
std::vector<std::string> failed_last_time(const std::string& out) {
  const auto file = (std::filesystem::path(out) / "results.json").string();
  if (!std::filesystem::exists(file))
    throw InputError("--last-failed: there is no " + file + " to look into: validate without it first");
  auto last = read_results(file);
  judge(last);
  std::vector<std::string> failed;
  for (const auto& c : last.cases)
    if (c.exit_code != exit_pass) failed.push_back(c.id);
  for (const auto& id : last.planned)
    if (std::none_of(last.cases.begin(), last.cases.end(), [&](const auto& c) { return c.id == id; }))
      failed.push_back(id);
  if (failed.empty())
    throw InputError("--last-failed: every case in " + file + " is green: nothing is to be run");
  return failed;
}

/// Holds OUT where it is there already: files of an earlier call are read and set aside before there are
/// runs.
std::optional<FolderLock> hold_earlier(const std::string& out) {
  if (!std::filesystem::is_directory(out)) return {};
  return hold_folder(out);
}

/// The cases of this call. The report of an earlier call is set aside, so that a call that ends 2 leaves
/// nothing to be judged in its place. A call that selects nothing, as one with a mistyped tag, asks for no
/// run and leaves the report as it is.
/// @param held a folder that was not there when we came holds nothing of ours to set aside
std::vector<Case> cases_of(const ValidateOptions& o, bool held) {
  try {
    auto cases = select_cases(o.filter);
    if (held) set_aside_report(o.suite.out);
    return cases;
  } catch (const NothingSelected&) {
    throw;
  } catch (...) {
    if (held) set_aside_report(o.suite.out);
    throw;
  }
}

/// An engine that was asked for is judged in each of its presets, where the case does not choose some of
/// them.
void add_all_presets(std::vector<Case>& cases, const std::vector<EngineEntry>& engines,
                     const std::vector<std::string>& asked) {
  for (auto& value : cases)
    for (const auto& name : asked) {
      const auto* engine = find_engine(engines, name);
      const bool is_listed = std::any_of(value.engines.begin(), value.engines.end(),
                                         [&](const auto& e) { return e.name == name; });
      if (!engine || !engine->available || is_listed || suits_itself_to_the_scene(name)) continue;
      EngineChoice choice;
      choice.name = name;
      choice.presets = engine->presets;
      value.engines.push_back(choice);
    }
}

/// The acceptance profile ends with a scorecard: as text here, and as page, Markdown and JSON in OUT.
void show_scorecard(const Results& results, const std::vector<Case>& cases,
                    const std::vector<EngineEntry>& engines, const ValidateOptions& o) {
  const auto card = scorecard_of(results, cases, engines);
  if (const auto missing = write_scorecard(card, o.suite.out); !missing.empty())
    say("tripoint: no page: " + missing);
  if (!o.json) print(scorecard_text(card, results.asked));
}

/// Jobs share the cores: threads beyond them would wait for each other, and change no result.
void fit_threads(SuiteOptions& suite) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency())),
            each = std::max(1, cores / suite.jobs);
  if (suite.jobs == 1 || suite.threads <= each) return;
  say(fmt::format("tripoint: {} jobs of {} threads do not fit on {} cores: each job takes {}", suite.jobs,
                  suite.threads, cores, each));
  suite.threads = each;
}

/// Which cases are run, and with which seed.
void choose_cases(ValidateOptions& o) {
  if (!o.shard.empty()) {
    const auto part = read_shard(o.shard);
    o.filter.shard = part.i;
    o.filter.shards = part.n;
  }
  if (o.last_failed) o.filter.only = failed_last_time(o.suite.out);
  o.filter.profile = !o.profile.empty() ? o.profile : o.filter.what.empty() && !o.last_failed ? "commit" : "";
  if (o.seed_given) o.suite.selection.seed = o.seed;
}

/// The runs of all cases, and their times where these are asked for.
Results run_all(const std::vector<Case>& cases, const std::vector<EngineEntry>& engines,
                const ValidateOptions& o) {
  auto results = run_suite(cases, engines, o.suite);
  if (o.timing <= 0) return results;
  for (auto& c : results.cases)
    for (const auto& value : cases)
      if (value.id == c.id && !interrupted()) time_case(value, engines, o.timing, o.suite, c);
  return results;
}

/// Records the call, so that the results can be judged without anything else.
void describe_call(Results& results, const ValidateOptions& o) {
  results.command = command_line();
  results.profile = o.filter.profile;
  results.date = date_now();
  results.shard = o.shard;
  results.what = o.filter.what;
  results.tag = o.filter.tag;
  // Else it is a part, and nobody can say of what
  results.filter_known = !o.last_failed && o.filter.substring.empty();
}

/// Where the history cannot be written, the numbers are kept all the same, and the call does not pass.
void keep_history(Results& results, const ValidateOptions& o) {
  const auto file =
      o.history.empty() ? (std::filesystem::path(o.suite.out) / "history.jsonl").string() : o.history;
  try {
    append_history(file, history_lines(results));
  } catch (const EngineError& e) {
    results.problems.emplace_back(e.what());
    if (results.exit_code == exit_pass) results.exit_code = exit_missing;
    results.verdict = verdict_of(results.exit_code);
    return;
  }
  results.history =
      std::filesystem::relative(std::filesystem::absolute(file), std::filesystem::absolute(o.suite.out))
          .string();
}

/// Limits with so much room that `gate` does not pass them: a call that is green would otherwise not mention
/// them. Empty where there are none.
std::string loose_limits(const Results& results, const std::string& out) {
  const auto remarks = headroom_remarks(results);
  const auto count = std::count_if(remarks.begin(), remarks.end(), [](const Remark& r) { return r.error; });
  if (count == 0) return {};
  return fmt::format(
      "loose: {} limit{} more than {:g} times what was measured: tripoint gate {} names {}, and does not "
      "pass\n",
      count, count == 1 ? " is" : "s are", headroom_fails, one_line(out), count == 1 ? "it" : "them");
}

int validate(ValidateOptions o) {
  catch_interrupts();
  fit_threads(o.suite);
  auto lock = hold_earlier(o.suite.out);
  choose_cases(o);
  if (o.sandbox) sandbox_third_parties(o.suite.out, o.suite.jobs);
  auto cases = cases_of(o, lock.has_value());
  const auto engines = engines_asked_for(o.engines.words(), o.suite.selection);
  if (o.profile == "acceptance") add_all_presets(cases, engines, o.suite.selection.asked);
  if (!lock) lock.emplace(hold_folder(o.suite.out));
  const std::size_t asked =
      o.suite.selection.engines.empty() ? engines.size() : o.suite.selection.engines.size();
  say(fmt::format("{} case{}, {} engine{}, into {}", cases.size(), cases.size() == 1 ? "" : "s", asked,
                  asked == 1 ? "" : "s", o.suite.out));
  for (const Case& c : cases)
    for (const Finding& f : old_keys(read_case(c.file))) say("note: " + with_place(f));
  o.suite.say = [](const std::string& line) { say(line); };
  if (!o.json) o.suite.on_case = [](const CaseResult& c) { print(case_line(c) + "\n"); };
  auto results = run_all(cases, engines, o);
  describe_call(results, o);
  judge(results);  // a shard is asked less than a whole suite
  if (o.keep_history) keep_history(results, o);
  if (o.profile == "acceptance") show_scorecard(results, cases, engines, o);  // the report links it
  if (!o.page)
    write_results(results, o.suite.out);
  else if (const auto missing = write_report(results, o.suite.out); !missing.empty())
    say("tripoint: no page: " + missing);
  if (!o.json) print(notes_text(results) + loose_limits(results, o.suite.out));
  print(o.json ? results_text(results) : last_line(results, o.suite.out) + "\n");
  return interrupted() ? exit_interrupted : results.exit_code;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("validate", validate_description);
  auto o = std::make_shared<ValidateOptions>();
  command->add_option("CASE", o->filter.what, "case files, folders of them, or ids")->type_name("CASE|DIR");
  command->add_option("--profile", o->profile, "only cases of this profile (commit where no CASE is given)")
      ->check(CLI::IsMember({"commit", "nightly", "release", "acceptance"}));
  command->add_option("--tag", o->filter.tag, "only cases with this tag");
  command->add_option("-k", o->filter.substring, "only cases with this in their id")->type_name("SUBSTRING");
  command->add_flag("--last-failed", o->last_failed, "only the cases that are not green in OUT/results.json");
  add_engines_option(*command, o->engines);
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--out", o->suite.out, "folder of the report and the runs")->capture_default_str();
  command->add_option("--jobs", o->suite.jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", o->suite.threads, "threads of each engine process")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option_function<std::uint64_t>(
      "--seed",
      [o](std::uint64_t seed) {
        o->seed = seed;
        o->seed_given = true;
      },
      "replaces the cases' seeds");
  command->add_flag(
      "--resume", o->suite.resume,
      "keep the runs in OUT that have ended, where job and engine are the same; make only the others");
  command
      ->add_option("--timing", o->timing,
                   "then time every run in this many interleaved rounds. One engine runs twice a round; the "
                   "difference of its two times is the noise floor")
      ->check(CLI::Range(2, 1000));
  command
      ->add_option("--count-instructions", o->suite.count_below,
                   "count instructions by callgrind where the processor does not, for runs below this many "
                   "CPU seconds. The second run is some fifty times slower")
      ->expected(0, 1)
      ->default_str("1")
      ->check(CLI::PositiveNumber)
      ->type_name("CPU_S");
  command->add_option("--history", o->history,
                      "file of JSON lines to which figures are appended, one line a case (default "
                      "OUT/history.jsonl); the report draws it");
  command->add_flag_callback(
      "--no-history", [o] { o->keep_history = false; }, "append nothing");
  command->add_option("--shard", o->shard, "i/n: every n-th case, from the i-th");
  command
      ->add_option("--time-limit", o->suite.wall_limit,
                   "seconds for one run; engine setting wall_limit goes before it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag_callback(
      "--no-report", [o] { o->page = false; },
      "draw no page: results.json, junit.xml and summary.md are written all the same");
  command->add_flag("--json", o->json, "print results.json, and nothing else, on stdout");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return validate(*o); }); });
}

}  // namespace tripoint
