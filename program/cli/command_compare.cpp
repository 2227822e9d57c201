// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
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

constexpr const char* converge_description =
    "Refines one axis of a case in our solver and prints error, order and its 95 % interval for each\n"
    "metric.\n"
    "  tripoint converge heat/cosine-mode --axis spacing --levels 1e-3,5e-4,2.5e-4,1.25e-4\n"
    "  tripoint converge rigid/torque-free --axis time_step --engine bullet\n"
    "Levels are in the axis's own unit (SI), coarse to fine. Without them the case's own study of this\n"
    "axis is taken. Four levels or more make an interval worth reading. OUT then holds the whole report.";

struct CompareOptions {
  std::string what, engines, out;
  int jobs = 1;
  bool sandbox = false;
};

struct ConvergeOptions {
  std::string what, axis = "spacing", engine = engine_name::solver, out;
  std::vector<double> levels;
  int jobs = 1;
  bool sandbox = false;
};

Case one_case(const std::string& what) {
  CaseFilter filter;
  filter.what = {what};
  auto cases = select_cases(filter);
  if (cases.size() != 1) throw InputError(what + ": names more than one case");
  return cases.front();
}

Results run_one_case(const Case& value, const SuiteOptions& options, const std::vector<std::string>& paths) {
  catch_interrupts();
  const auto engines = discover_engines(paths);
  for (const auto& name : options.selection.engines)
    if (!find_engine(engines, name)) throw EngineError(no_such_engine(name, engines));
  const auto lock = hold_folder(options.out);
  auto results = run_suite({value}, engines, options);
  results.command = command_line();
  if (const auto missing = write_report(results, options.out); !missing.empty())
    say("tripoint: no page: " + missing);
  return results;
}

/// Exit code for the fault that kept the runs from being compared; accuracy is not judged here.
int code_of_runs(const CaseResult& result) {
  if (interrupted()) return exit_interrupted;
  int code = exit_pass;
  for (const auto& e : result.engines) {
    if (e.status == Status::diverged) return exit_diverged;
    if (e.status != Status::ok) {
      say(fmt::format("{} {}: {}", e.name, e.status, e.reason));
      code = exit_missing;
    }
  }
  return code;
}

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

Study study_for(const Case& value, const ConvergeOptions& o) {
  Study study;
  study.axes.axis = from_word<Axis>(o.axis);
  study.engine = o.engine;
  study.levels = o.levels;
  for (const auto& s : value.studies)
    if (s.axes.axis == study.axes.axis && study.levels.empty() &&
        (s.engine.empty() || s.engine == o.engine)) {
      study.levels = s.levels;
      study.order = s.order;
      study.jitter = s.jitter;
      study.seeds = s.seeds;
    }
  if (study.levels.empty())
    throw InputError(fmt::format("{} has no study of {} for {}: name --levels a,b,c, coarse to fine",
                                 value.id, o.axis, o.engine));
  for (const double level : study.levels)
    if (!(level > 0.0)) throw InputError(fmt::format("--levels: {:g} is no level; they are positive", level));
  return study;
}

void print_order(const OrderRow& o) {
  print_line(fmt::format("{}{}{} over {}", o.metric, o.mode == JudgedMode::none ? "" : ", ", o.mode,
                         to_string(o.axes)));
  for (std::size_t k = 0; k < o.step.size(); ++k) {
    const bool ratio = k > 0 && o.error[k] != 0.0;
    print_line(fmt::format("  {:<12.5g} {:12.5g}  +- {:<9.2g} {}", o.step[k], o.error[k], o.uncertainty[k],
                           ratio ? fmt::format("/ {:.3g}", o.error[k - 1] / o.error[k]) : ""));
  }
  print(fmt::format("  order {:.3f}, 95 % interval {:.3f} to {:.3f}, {}\n", o.order.value, o.order.low,
                    o.order.high, o.order.fit_class));
}

int converge(const ConvergeOptions& o) {
  auto value = one_case(o.what);
  value.studies = {study_for(value, o)};
  const auto words = sort_engine_words(files_as_paths({o.engine}));
  SuiteOptions options;
  options.out = o.out.empty() ? own_folder("converge", value.id) : o.out;
  if (o.sandbox) sandbox_third_parties(options.out, o.jobs);
  options.selection.engines =
      words.paths.empty() ? words.names : std::vector<std::string>{ask_engine(words.paths.front()).name};
  value.studies.front().engine = options.selection.engines.front();
  options.jobs = o.jobs;
  options.say = [](const std::string& line) { say(line); };
  options.wanted = [&](const EnginePlan&, const RunPlan& run) { return !run.levels.empty(); };
  const auto results = run_one_case(value, options, words.paths);
  if (results.cases.empty()) return exit_interrupted;
  for (const auto& e : results.cases.front().engines)
    for (const auto& order : e.order) print_order(order);
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

void add_converge(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("converge", converge_description);
  auto o = std::make_shared<ConvergeOptions>();
  command->add_option("CASE", o->what, "a case file or id")->required();
  command->add_option("--axis", o->axis, "the refined axis")
      ->check(CLI::IsMember(axis_words()))
      ->capture_default_str();
  command->add_option("--levels", o->levels, "a,b,c: coarse to fine")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--engine", o->engine, "name or path")->capture_default_str();
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--out", o->out, "folder of the report and the runs (default: report-converge/CASE)");
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o, &exit_code] { exit_code = guarded([&] { return converge(*o); }); });
}

}  // namespace tripoint
