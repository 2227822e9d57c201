// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/gate_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/common.hpp"
#include "validation/baseline/baseline_propose.hpp"
#include "validation/baseline/changes.hpp"
#include "validation/baseline/gate_verdict.hpp"
#include "validation/baseline/history.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/judge/judge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* propose_description =
    "Writes a patch of the baselines that `gate accept` would write, and accepts nothing. Above the patch\n"
    "stand its changes as text and the line that accepts it. Without --reason the patch says that nobody\n"
    "has decided, and such a baseline is red (exit 4).\n"
    "  tripoint gate propose report/results.json flight/throw --patch baselines.patch";

bool on_github() {
  const char* set = std::getenv("GITHUB_ACTIONS");
  return set && std::string(set) == "true";
}

/// The nearest folder above the results from which the path of the case is right; empty = none.
fs::path folder_above(const std::string& results, const std::string& case_file) {
  std::error_code none;
  for (auto folder = fs::absolute(results).lexically_normal().parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    if (fs::is_regular_file(folder / case_file, none)) return folder;
  return {};
}

/// Nothing is blocked, so nothing is called an error.
std::vector<Remark> as_warnings(std::vector<Remark> remarks) {
  for (auto& r : remarks) r.error = false;
  return remarks;
}

std::string last_words(const GateVerdict& verdict, bool informational) {
  if (!informational || verdict.code == exit_pass)
    return fmt::format("verdict {} exit {}{}", verdict.word, verdict.code, verdict.absent);
  return fmt::format("verdict {} exit 0 (informational; without --informational exit {}){}", verdict.word,
                     verdict.code, verdict.absent);
}

}  // namespace

Results judged_results(const std::string& path) {
  auto results = read_results(results_file(path));
  judge(results);
  return results;
}

void say_if_called_elsewhere(const Results& results, const std::string& path) {
  std::error_code none;
  const auto is_elsewhere = [&](const CaseResult& c) {
    return !c.file.empty() && fs::path(c.file).is_relative() && !fs::exists(c.file, none);
  };
  if (results.cases.empty() || !std::all_of(results.cases.begin(), results.cases.end(), is_elsewhere)) return;
  const auto& file = results.cases.front().file;
  const auto folder = folder_above(path, file);
  say(
      fmt::format("tripoint: {} names cases by their paths from the folder in which validate was called, and "
                  "{} is not in {}: "
                  "call this command in {}",
                  printable(path, 200), printable(file, 200), fs::current_path(none).string(),
                  folder.empty() ? "that folder, if the case is still there" : folder.string()));
}

int judge_results(const JudgeOptions& o) {
  if (o.against.empty() && (o.no_worse || !o.again.empty()))
    throw InputError("gate: --no-worse and --again compare with a base: name it with --against BASE.json");
  const auto results = judged_results(o.results);
  say_if_called_elsewhere(results, o.results);
  auto verdict = gate_verdict(results, o.baselines, o.require_baselines);
  std::optional<Comparison> comparison;
  if (!o.against.empty()) {
    const auto base = judged_results(o.against);
    const auto again = o.again.empty() ? std::optional<Results>() : judged_results(o.again);
    comparison = compare_results(base, results, o.against, again ? &*again : nullptr);
    add_remarks(verdict, results, change_remarks(*comparison, o.no_worse));
  }
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  if (comparison) print(changes_table(*comparison));
  const auto remarks = o.informational ? as_warnings(verdict.remarks) : verdict.remarks;
  if (o.annotations || on_github())
    print_commands(annotations_text(remarks));
  else
    print(remarks_text(remarks));
  if (!o.history.empty()) append_history(o.history, history_lines(results));
  print(notes_text(results));
  print_line(last_words(verdict, o.informational));
  return o.informational ? exit_pass : verdict.code;
}

int propose_baselines(const ProposeOptions& o) {
  std::string path = "report/results.json";
  std::vector<std::string> ids;
  for (const auto& w : o.words) (w.ends_with(".json") ? path = w : ids.emplace_back(w));
  const auto results = judged_results(path);
  say_if_called_elsewhere(results, path);
  if (const auto wrong = recheck_remarks(results); !wrong.empty())
    throw InputError(path + ": " + wrong.front().title + ": " + wrong.front().text);
  const auto list = proposals(
      results, ids,
      {results.date.substr(0, 10), results.tool.commit, o.reason.empty() ? undecided_reason : o.reason},
      {.keep = true, .drop = true});
  const auto text =
      patch_text(list, path, list.empty() ? "." : patch_root(list.front().file), o.reason.empty());
  if (o.patch.empty()) {
    print(text);
    return exit_pass;
  }
  write_durably(o.patch, text);
  for (const auto& line : split(text, '\n'))
    if (line.starts_with("# ")) print_line(line.substr(2));
  print_line("the patch is " + o.patch + "; git apply reads it");
  return exit_pass;
}

void add_judge_options(CLI::App& gate, JudgeOptions& o) {
  gate.add_option("RESULTS", o.results, "a results.json, or the folder of one");
  gate.add_option(
          "--against", o.against,
          "print every metric beside that of this base, with the change in units of its limit and the noise")
      ->type_name("BASE.json");
  gate.add_option(
          "--again", o.again,
          "with --against: results of the base once more (A/A); what differs between the two counts as noise")
      ->type_name("BASE2.json");
  gate.add_flag("--no-worse", o.no_worse,
                "with --against: worse than the base by more than its noise is red (exit 1). A missing "
                "metric or a looser limit is exit 4");
  gate.add_flag("--informational", o.informational, "say the verdict, and end 0 whatever it is");
  gate.add_flag("--annotations", o.annotations,
                "remarks as workflow commands of GitHub (also where GITHUB_ACTIONS is true): ten of a kind, "
                "the worst first");
  gate.add_option("--baselines", o.baselines,
                  "judge by the baselines in this folder, for example those of the target branch (default: "
                  "beside the cases). One that is gone beside the cases is exit 4")
      ->type_name("DIR");
  gate.add_flag("--require-baselines", o.require_baselines,
                "a case without a baseline is exit 4 (else a warning). With --baselines a case that has one "
                "there and no results is too");
  gate.add_option("--history", o.history,
                  "append a line of JSON a case, with every value and count, to this file (validate has done "
                  "so to OUT/history.jsonl)");
}

CLI::App* add_propose(CLI::App& gate, ProposeOptions& o) {
  auto* command = gate.add_subcommand("propose", propose_description);
  command->add_option("--reason", o.reason, "who decided what, and why; without it the patch is undecided");
  command->add_option("--patch", o.patch, "file of the patch (default: on stdout)");
  command->add_option("RESULTS|ID", o.words,
                      "a results.json (default report/results.json), and the ids of the cases; none = all");
  return command;
}

}  // namespace tripoint
