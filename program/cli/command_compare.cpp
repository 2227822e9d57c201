// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/one_case.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

constexpr const char* compare_description =
    "Runs one case on the named engines and states their equivalence. For each metric it prints the\n"
    "difference of their trajectories, its uncertainty and the margin of the case. Both errors to truth\n"
    "stand beside it, which shows two engines that are wrong together.\n"
    "  tripoint compare rigid/ballistic --engines tripoint,bullet\n"
    "Exit: 0 compared, 4 an engine did not run or two scenes are not the same scene, 7 diverged.";

struct CompareOptions {
  std::string what, engines, out;
  int jobs = 1;
  bool sandbox = false;
};

int compare(const CompareOptions& o) {
  const auto value = one_case(o.what);
  const auto words = sort_engine_words(split(o.engines));
  SuiteOptions options;
  options.out = o.out.empty() ? own_folder("compare", value.id) : o.out;
  if (o.sandbox) sandbox_third_parties(options.out, o.jobs);
  options.selection.engines = words.names;
  for (const auto& path : words.paths) options.selection.engines.push_back(ask_engine(path).name);
  if (options.selection.engines.size() < 2)
    throw InputError("--engines " + o.engines + ": name two engines or more, for example tripoint,bullet");
  options.jobs = o.jobs;
  options.say = [](const std::string& line) { say(line); };
  options.wanted = [](const EnginePlan&, const RunPlan& run) { return run.base; };
  const auto results = run_one_case(value, options, words.paths);
  if (results.cases.empty()) return exit_interrupted;
  if (results.cases.front().equivalence.empty())
    say("nothing is compared here: two engines are, and exact is the truth that both are judged by (tripoint "
        "validate)");
  print(fmt::format("{:20} {:20} {:20} {:>11} {:>11} {:>11} {:>11} {:>11}  verdict\n", "a", "b", "metric",
                    "difference", "uncertainty", "margin", "error a", "error b"));
  for (const auto& q : results.cases.front().equivalence)
    print_line(fmt::format(
        "{:20} {:20} {:20} {:11.4g} {:11.2g} {:>11} {:11.4g} {:11.4g}  {}", q.a, q.b, q.metric, q.difference,
        q.uncertainty, q.margin ? fmt::format("{:.4g}", *q.margin) : "-", q.error_a, q.error_b, q.verdict));
  print((std::filesystem::path(options.out) / "index.html").string() + "\n");
  return code_of_runs(results.cases.front());
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("compare", compare_description);
  auto o = std::make_shared<CompareOptions>();
  command->add_option("CASE", o->what, "a case file or id")->required();
  command->add_option("--engines", o->engines, "names or paths, A,B")->required();
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--out", o->out, "folder of the report and the runs (default: report-compare/CASE)");
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o, &exit_code] { exit_code = guarded([&] { return compare(*o); }); });
}

}  // namespace tripoint
