// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "core/errors.hpp"
#include "core/written_file.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/one_case.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/metrics/roache.hpp"
#include "validation/references/measuring.hpp"
#include "validation/results/results.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

std::string steps_table(const OrderRow& row, const std::string& unit) {
  std::string text = fmt::format("| {} | value [{}] | change |\n|---|---|---|\n", to_string(row.axes), unit);
  for (std::size_t k = 0; k < row.step.size(); ++k)
    text += fmt::format("| {:.6g} | {:.6g} | {} |\n", row.step[k], row.error[k],
                        k > 0 ? fmt::format("{:.3g}", row.error[k] - row.error[k - 1]) : "-");
  return text;
}

std::string conclusion(const OrderRow& row, const std::string& unit) {
  const RoacheIndex r = roache_index(row.step, row.error);
  const double finest = row.error.back(), share = 100.0 * r.index / std::abs(finest);
  if (!r.monotone)
    return fmt::format(
        "The values go up and down, so that no order is observed and no limit extrapolated. The index is "
        "three "
        "times their largest change: {:.4g} {} ({:.3g} % of the finest value). Refine further.\n",
        r.index, unit, share);
  return fmt::format(
      "| | |\n|---|---|\n| observed order | {:.3f} |\n| extrapolated value | {:.6g} {} |\n"
      "| grid convergence index of the finest value | {:.3g} {} ({:.3g} %) |\n| factor of safety | {:.2f} "
      "|\n\n"
      "The value is {:.6g} {} +- {:.2g} {} [Roache 1994].\n",
      r.order, r.limit, unit, r.index, unit, share, r.factor, finest, unit, r.index, unit);
}

/// Leaves the case with this metric alone: its own of that name, or a new one of that quantity, which is
/// compared with 0. @throws InputError where it is neither
void ask_for(Case& value, const std::string& metric) {
  const auto own = std::ranges::find(value.metrics, metric, &MetricChoice::name);
  MetricChoice one;
  if (own != value.metrics.end()) {
    one = *own;
  } else {
    std::vector<std::string> known;
    for (const auto& m : value.metrics) known.push_back(m.name);
    for (const auto& q : metric_quantities()) known.push_back(q.name);
    if (std::ranges::find(known, metric) == known.end())
      throw InputError("--metric " + metric + " is no metric of the case and no quantity" +
                       suggestion(metric, known));
    one.name = one.quantity = metric;
    one.norm = Norm::final;
    one.reference = value.reference;
    one.reference->kind = ReferenceKind::self;
    one.reference->function = "self";
    const auto measuring = measuring_arguments();
    std::erase_if(one.reference->args, [&](const auto& arg) {
      return std::ranges::find(measuring, arg.first, &ReferenceArgument::name) == measuring.end();
    });
  }
  value.metrics = {one};
  value.gates.clear();
  value.studies.front().metric = one.name;
}

/// Prints values, observed order, extrapolated value and grid convergence index, and writes
/// OUT/convergence.md.
void tell_convergence(const CaseResult& result, const Case& value, const std::string& out) {
  const MetricChoice& metric = value.metrics.front();
  std::string page = fmt::format("# {}: {}\n", value.id, metric.name);
  bool any = false;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.order) {
      const std::string unit = unit_of_value(metric);
      page += fmt::format("\n## {}{}{}\n\n{}\n{}", engine.name, row.mode == JudgedMode::none ? "" : ", ",
                          row.mode, steps_table(row, unit), conclusion(row, unit));
      any = true;
    }
  if (!any) page += "\nA level has no value: see the reasons of its runs in index.html.\n";
  const std::string file = (std::filesystem::path(out) / "convergence.md").string();
  WrittenFile to(file);
  to.add(page);
  to.close();
  print(page + file + "\n");
}

constexpr const char* converge_description =
    "Refines one axis of a case in our solver and prints error, order and its 95 % interval for each\n"
    "metric.\n"
    "  tripoint converge heat/cosine-mode --axis spacing --levels 1e-3,5e-4,2.5e-4,1.25e-4\n"
    "  tripoint converge rigid/torque-free --axis time_step --engine bullet\n"
    "  tripoint converge dam.toml --metric pressure_at --levels 0.02,0.0141,0.01\n"
    "--metric takes a metric of the case, or any quantity. It prints observed order, extrapolated value\n"
    "and Roache's grid convergence index, and writes OUT/convergence.md; no truth is needed.\n"
    "Levels are in the axis's own unit (SI), coarse to fine. Without them the case's own study of this\n"
    "axis is taken. Four levels or more make an interval worth reading. OUT then holds the whole report.";

struct ConvergeOptions {
  std::string what, axis = "spacing", metric, engine = engine_name::solver, out;
  std::vector<double> levels;
  int jobs = 1;
  bool sandbox = false;
};

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
  if (study.levels.empty() && !o.metric.empty() && study.axes.axis == Axis::spacing) {
    const double dx = value.scene.spacing;
    study.levels = {2.0 * dx, std::sqrt(2.0) * dx, dx};
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
  if (!o.metric.empty()) ask_for(value, o.metric);
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
  if (!o.metric.empty()) tell_convergence(results.cases.front(), value, options.out);
  print((std::filesystem::path(options.out) / "index.html").string() + "\n");
  return code_of_runs(results.cases.front());
}

}  // namespace

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
  command->add_option("--metric", o->metric, "a metric of the case, or a quantity");
  command->add_option("--engine", o->engine, "name or path")->capture_default_str();
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--out", o->out, "folder of the report and the runs (default: report-converge/CASE)");
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o, &exit_code] { exit_code = guarded([&] { return converge(*o); }); });
}

}  // namespace tripoint
