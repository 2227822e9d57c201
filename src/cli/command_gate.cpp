// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/commands.hpp"
#include "cli/common.hpp"
#include "cli/gate_adopt.hpp"
#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "validation/harness/baseline.hpp"
#include "validation/harness/history.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/recheck.hpp"
#include "validation/harness/report_files.hpp"
#include "validation/harness/seeds.hpp"
#include "validation/harness/selftest.hpp"
#include "validation/harness/slack.hpp"
#include "validation/harness/suite.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* description =
    "Judges a results.json from its measured values and limits alone; it runs nothing and trusts no stored verdict, and\n"
    "reads the case files again: metrics, gates, runs and values must be those of the cases as they are. Then it judges the\n"
    "limits: none more than 10 times its error (above 3 times warns) unless its reason is dated, none looser than the accepted baseline,\n"
    "no gate gone that was accepted, no value moved by more than the drift that its gate states, no run with more than 1 % more pairs, steps or\n"
    "instructions than accepted. A case without a baseline yet is named in a warning.\n"
    "  tripoint gate report/results.json     exit 0 only when every gate is green\n"
    "  tripoint gate accept report/results.json --reason 'who decided what, and why'     the only writer of baselines\n"
    "  tripoint gate adopt --engine ./my-engine --out cases     writes gates for an engine of your own\n"
    "  tripoint gate selftest                proves that the gates can fail, and only where they should";

constexpr const char* accept_description =
    "Accepts the figures of green cases as their baselines (baselines/<subject>/<case>.toml beside the folder cases), and prints what changes:\n"
    "old limit, new limit, and the sum of all loosenings since the first baseline.\n"
    "  tripoint gate accept --reason 'kernel moments corrected, decision 006' report/results.json heat/cosine-mode";

constexpr const char* selftest_description =
    "Runs every defect that the cases declare in the test build of our solver, and expects the gates named in killed_by to turn red;\n"
    "and asks that every defect which a physical term registers has a case that kills it. Then runs every harmless change that the cases\n"
    "declare (threads, order, ulp, boost, mirror, rotation, units): no gate may turn and no metric may change by more than round-off.\n"
    "Of defects that state a `smallest` size it finds by bisection the least one that turns the gate red: a table, red where it has grown by more than a quarter.\n"
    "With --seeds N it looks for false alarms instead: all that chance has a hand in (jittered particles, walkers) runs again with N other seeds.\n"
    "Exit 5 when a defect survives, a gate turns by its seed, a harmless change is felt, or a smallest visible defect has grown.\n"
    "  tripoint gate selftest                every case\n"
    "  tripoint gate selftest heat/cosine-mode --jobs 2\n"
    "  tripoint gate selftest --smallest     only the table of smallest visible defects\n"
    "  tripoint gate selftest --seeds 20     twenty other seeds: no gate of the commit profile may turn";

struct GateOptions {
  std::string results, history, profile, baselines;
  int seeds = 0;
  bool annotations = false, json = false, require_baselines = false;
  SelftestOptions selftest;
  std::vector<std::string> accepted;  ///< a results.json and ids, in any order
  std::string reason;
  bool removed = false;  ///< the ids are of cases that are no more
};

Results judged(const std::string& path) {
  auto results = read_results(path);
  judge(results);
  return results;
}

bool on_github() {
  const char* set = std::getenv("GITHUB_ACTIONS");
  return set && std::string(set) == "true";
}

bool holds_baselines(const std::string& folder) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, std::filesystem::directory_options::follow_directory_symlink))
    if (entry.path().extension() == ".toml") return true;
  return false;
}

int judge_file(const GateOptions& o) {
  const auto results = judged(results_file(o.results));
  auto remarks = verdict_remarks(results);
  if (!o.baselines.empty() && !std::filesystem::is_directory(o.baselines)) throw InputError("--baselines " + o.baselines + ": is no folder");
  if (!o.baselines.empty() && !holds_baselines(o.baselines)) throw InputError("--baselines " + o.baselines + ": holds no baseline (SUBJECT/CASE.toml), and nothing would be judged by it");
  for (const auto& list : {recheck_remarks(results), slack_remarks(results), baseline_remarks(results, o.require_baselines, o.baselines), lost_case_remarks(results, o.baselines)}) remarks.insert(remarks.end(), list.begin(), list.end());
  if (const auto commit = this_tool().commit; results.tool.commit != commit)
    remarks.push_back({false, 0, {}, "the results", fmt::format("were made by commit {}, and this program is of {}: validate again to judge what is here", results.tool.commit, commit), 1.0, {}});
  if (!results.shard.empty() && !results.shard.ends_with("/1"))
    remarks.push_back({false, 0, {}, "the results", fmt::format("are part {} of a suite: tripoint merge joins the parts, and the whole is judged", results.shard), 1.0, {}});
  if (!results.filter_known && !results.cases.empty())
    remarks.push_back({false, 0, {}, "the results", "are of chosen cases (-k, --last-failed, or another command than validate): what was left out is not judged here", 1.0, {}});
  std::set<int> codes{results.exit_code};
  for (const auto& r : remarks)
    if (r.error) codes.insert(r.code);
  const int code = first_of(codes);
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  print(o.annotations || on_github() ? annotations_text(remarks) : remarks_text(remarks));
  if (!o.history.empty()) append_history(o.history, history_lines(results));
  print(notes_text(results));
  std::string absent;
  for (const auto& [name, count] : accepted_but_absent(results, o.baselines)) absent += fmt::format("{}{} of {}", absent.empty() ? "; accepted gates that are not judged here: " : ", ", count, name);
  print(fmt::format("verdict {} exit {}{}\n", verdict_word(code, results, remarks), code, absent));
  return code;
}

int accept_file(const GateOptions& o) {
  std::string path = "report/results.json";
  std::vector<std::string> ids;
  for (const auto& word : o.accepted) (word.ends_with(".json") ? path = word : ids.emplace_back(word));
  if (o.removed) return print(accept_removal(ids, {{}, {}, o.reason})), exit_pass;
  const auto results = judged(path);
  if (const auto wrong = recheck_remarks(results); !wrong.empty()) throw InputError(path + ": " + wrong.front().title + ": " + wrong.front().text);
  const Acceptance acceptance{results.date.substr(0, 10), results.tool.commit, o.reason};
  print(accept(results, ids, acceptance));
  if (const auto history = history_file(results, path); !history.empty()) append_history(history, acceptance_lines(results, ids, acceptance));
  return exit_pass;
}

int selftest_seeds(const SelftestOptions& options, const std::string& profile, int count, bool json) {
  CaseFilter filter;
  filter.what = options.what, filter.profile = !profile.empty() ? profile : options.what.empty() ? "commit" : "";
  const auto outcome = try_seeds(select_cases(filter), discover_engines(), count, options);
  print(json ? seeds_json(outcome) : seeds_table(outcome));
  std::filesystem::create_directories(options.out);
  write_durably((std::filesystem::path(options.out) / "seeds.txt").string(), seeds_table(outcome));
  write_durably((std::filesystem::path(options.out) / "seeds.json").string(), seeds_json(outcome));
  return outcome.exit_code;
}

int selftest(SelftestOptions options, const std::string& profile, int seeds, bool json) {
  catch_interrupts();
  options.say = [](const std::string& line) { say(line); };
  if (seeds > 0) return selftest_seeds(options, profile, seeds, json);
  const auto outcome = run_selftest(options);
  print(json ? selftest_json(outcome) : selftest_table(outcome));
  std::filesystem::create_directories(options.out);
  write_durably((std::filesystem::path(options.out) / "selftest.txt").string(), selftest_table(outcome));
  write_durably((std::filesystem::path(options.out) / "selftest.json").string(), selftest_json(outcome));
  return outcome.exit_code;
}

}  // namespace

void add_gate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("gate", description);
  auto o = std::make_shared<GateOptions>();
  command->add_option("RESULTS", o->results, "a results.json, or the folder of one");
  command->add_flag("--annotations", o->annotations, "remarks as workflow commands of GitHub (also where GITHUB_ACTIONS is true): ten of a kind, the worst first");
  command->add_option("--baselines", o->baselines, "judge by the baselines in this folder, for example those of the branch that a change is to go into (default: beside the cases)")->type_name("DIR");
  command->add_flag("--require-baselines", o->require_baselines, "a case that has no baseline is an error, exit 4 (else one warning names them)");
  command->add_option("--history", o->history, "append a line of JSON a case, with every value and count, to this file (validate has done so to OUT/history.jsonl)");
  auto* accepts = command->add_subcommand("accept", accept_description);
  accepts->add_option("--reason", o->reason, "who decided what, and why")->required();
  accepts->add_flag("--removed", o->removed, "the ids (or paths) are of cases that are no more: their baselines are removed");
  accepts->add_option("RESULTS|ID", o->accepted, "a results.json (default report/results.json), and the ids of the cases; none = all");
  auto* self = command->add_subcommand("selftest", selftest_description);
  self->add_option("CASE", o->selftest.what, "case files, folders or ids; none = every case")->type_name("CASE|DIR");
  self->add_option("--out", o->selftest.out, "folder of the runs")->capture_default_str();
  self->add_option("--jobs", o->selftest.jobs, "engine processes at a time")->check(CLI::Range(1, 1024))->capture_default_str();
  self->add_flag("--smallest", o->selftest.only_smallest, "only the smallest visible defects");
  self->add_option("--seeds", o->seeds, "other seeds to run what chance has a hand in with; nothing else is then done")->check(CLI::Range(1, 10000));
  self->add_option("--profile", o->profile, "with --seeds: only cases of this profile (commit where no CASE is given)")->check(CLI::IsMember({"commit", "nightly", "release"}));
  self->add_flag("--json", o->json, "print selftest.json, and nothing else, on stdout");
  auto* adopts = add_gate_adopt(*command, exit_code);
  command->callback([=, &exit_code] {
    if (adopts->parsed()) return;  // it has run
    exit_code = guarded([&] {
      if (self->parsed()) return selftest(o->selftest, o->profile, o->seeds, o->json);
      if (accepts->parsed()) return accept_file(*o);
      if (o->results.empty()) throw InputError("gate: name a results.json, or accept, or selftest");
      return judge_file(*o);
    });
  });
}

}  // namespace tripoint
