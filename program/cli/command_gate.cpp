// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/gate_judge.hpp"
#include "program/cli/options.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/baseline/history.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/mutation/seeds.hpp"
#include "validation/mutation/selftest.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* gate_description =
    "Judges a results.json from its measured values and limits alone; it runs nothing and trusts no\n"
    "stored verdict. It reads the case files again: metrics, gates, runs and values must be theirs. A\n"
    "limit of more than 10 times its error is red, unless its reason is dated; above 3 times warns.\n"
    "Against the accepted baseline these are red: a looser limit, a missing gate, and a value moved by\n"
    "more than its gate's drift. A run with over 1 % more pairs, steps or instructions is red too. A case\n"
    "without a baseline is named in a warning.\n"
    "  tripoint gate report/results.json     exit 0 only when every gate is green\n"
    "  tripoint gate report --against base/results.json     every metric beside that of a base, in "
    "units of its limit\n"
    "  tripoint gate accept report/results.json --reason 'who decided what, and why'     the only "
    "writer of baselines\n"
    "  tripoint gate adopt --engine ./my-engine --out cases     writes gates for an engine of your own\n"
    "  tripoint gate selftest                proves that the gates can fail, and only where they should";

constexpr const char* accept_description =
    "Accepts the figures of green cases as their baselines (baselines/<subject>/<case>.toml beside the\n"
    "folder cases). It prints old limit, new limit, and the sum of all loosenings since the first\n"
    "baseline. Results that lack an accepted engine or metric are refused, unless --keep-missing or\n"
    "--drop-missing is given.\n"
    "  tripoint gate accept --reason 'kernel moments corrected, decision 006' report/results.json "
    "heat/cosine-mode";

constexpr const char* selftest_description =
    "Runs every defect that the cases declare in the test build of our solver; the gates in killed_by\n"
    "must turn red. Every defect that a physical term registers must have a case that kills it. Then it\n"
    "runs the invariance tests of the cases (threads, order, ulp, boost, mirror, rotation, units). In\n"
    "them no gate may turn, and no metric may change by more than round-off. Defects with a key\n"
    "`smallest` are bisected for the least size that turns the gate red. Growth by more than a quarter\n"
    "fails. With --seeds N it looks for false alarms instead: runs with jittered particles or walkers are\n"
    "repeated with N other seeds. It ends 5 when a defect survives, a gate turns by its seed, an\n"
    "invariance test fails, or a smallest visible defect has grown.\n"
    "  tripoint gate selftest                every case\n"
    "  tripoint gate selftest heat/cosine-mode --jobs 2\n"
    "  tripoint gate selftest --smallest     only the table of smallest visible defects\n"
    "  tripoint gate selftest --seeds 20     twenty other seeds: no gate of the commit profile may turn";

struct GateOptions {
  JudgeOptions judge;
  ProposeOptions propose;
  std::string profile;
  int seeds = 0;
  bool json = false;
  SelftestOptions selftest;
  std::vector<std::string> accepted;  ///< a results.json or its folder, and ids, in any order
  std::string reason;
  bool removed = false;  ///< the ids are of cases that are no more
  Lacking lacking;
};

int accept_file(const GateOptions& o) {
  std::string path;
  std::vector<std::string> ids;
  const auto take = [&](const std::string& results) {
    if (!path.empty())
      throw InputError(path + " and " + results + " are two results: accept one of them at a time");
    path = results;
  };
  for (const auto& word : o.accepted) {
    const auto within = std::filesystem::path(word) / "results.json";  // also the folder of a report is named
    std::error_code none;
    if (std::filesystem::is_regular_file(within, none))
      take(within.string());
    else if (word.ends_with(".json"))
      take(word);
    else
      ids.push_back(word);
  }
  if (o.removed) {
    print(accept_removal(ids, {{}, {}, o.reason}));
    return exit_pass;
  }
  if (path.empty()) path = "report/results.json";
  const auto results = judged_results(path);
  say_if_called_elsewhere(results, path);
  if (const auto wrong = recheck_remarks(results); !wrong.empty())
    throw InputError(path + ": " + wrong.front().title + ": " + wrong.front().text);
  const Acceptance acceptance{results.date.substr(0, 10), results.tool.commit, o.reason};
  print(accept(results, ids, acceptance, o.lacking));
  if (const auto history = history_file(results, path); !history.empty())
    append_history(history, acceptance_lines(results, ids, acceptance));
  return exit_pass;
}

int selftest_seeds(const SelftestOptions& options, const std::string& profile, int count, bool json) {
  CaseFilter filter;
  filter.what = options.what;
  filter.profile = !profile.empty() ? profile : options.what.empty() ? "commit" : "";
  const auto outcome = try_seeds(select_cases(filter), discover_engines(), count, options);
  print(json ? seeds_json(outcome) : seeds_table(outcome));
  write_durably((std::filesystem::path(options.out) / "seeds.txt").string(), seeds_table(outcome));
  write_durably((std::filesystem::path(options.out) / "seeds.json").string(), seeds_json(outcome));
  return outcome.exit_code;
}

int selftest(SelftestOptions options, const std::string& profile, int seeds, bool json) {
  catch_interrupts();
  options.say = [](const std::string& line) { say(line); };
  const auto lock = hold_folder(options.out);
  if (seeds > 0) return selftest_seeds(options, profile, seeds, json);
  const auto outcome = run_selftest(options);
  print(json ? selftest_json(outcome) : selftest_table(outcome));
  write_durably((std::filesystem::path(options.out) / "selftest.txt").string(), selftest_table(outcome));
  write_durably((std::filesystem::path(options.out) / "selftest.json").string(), selftest_json(outcome));
  return outcome.exit_code;
}

}  // namespace

void add_gate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("gate", gate_description);
  auto o = std::make_shared<GateOptions>();
  add_judge_options(*command, o->judge);
  auto* proposes = add_propose(*command, o->propose);
  auto* accepts = command->add_subcommand("accept", accept_description);
  accepts->add_option("--reason", o->reason, "who decided what, and why")->required();
  accepts->add_flag("--removed", o->removed,
                    "the ids (or paths) are of cases that are no more: their baselines are removed");
  accepts->add_flag("--keep-missing", o->lacking.keep,
                    "accepted rows of engines that did not run stay as they are");
  accepts->add_flag("--drop-missing", o->lacking.drop,
                    "accepted rows that the results lack are removed; --reason says why");
  accepts->add_option(
      "RESULTS|ID", o->accepted,
      "a results.json or its folder (default report/results.json), and the ids of the cases; none = all");
  auto* self = command->add_subcommand("selftest", selftest_description);
  self->add_option("CASE", o->selftest.what, "case files, folders or ids; none = every case")
      ->type_name("CASE|DIR");
  self->add_option("--out", o->selftest.out, "folder of the runs")->capture_default_str();
  self->add_option("--jobs", o->selftest.jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  self->add_flag("--smallest", o->selftest.only_smallest, "only the smallest visible defects");
  self->add_option("--seeds", o->seeds, "other seeds for runs with random numbers; nothing else is then done")
      ->check(CLI::Range(1, 10000));
  self->add_option("--profile", o->profile,
                   "with --seeds: only cases of this profile (commit where no CASE is given)")
      ->check(CLI::IsMember({"commit", "nightly", "release"}));
  self->add_flag("--json", o->json, "print selftest.json, and nothing else, on stdout");
  auto* adopts = add_gate_adopt(*command, exit_code);
  command->callback([=, &exit_code] {
    if (adopts->parsed()) return;  // it has run
    exit_code = guarded([&] {
      if (self->parsed()) return selftest(o->selftest, o->profile, o->seeds, o->json);
      if (accepts->parsed()) return accept_file(*o);
      if (proposes->parsed()) return propose_baselines(o->propose);
      if (o->judge.results.empty())
        throw InputError(
            "gate: name a results.json, for example report/results.json, or one of its commands:\n" +
            commands_of(*command));
      return judge_results(o->judge);
    });
  });
}

}  // namespace tripoint
