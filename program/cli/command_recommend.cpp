// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/options.hpp"
#include "validation/campaign/accuracy_cost.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

constexpr const char* recommend_description =
    "Measures the cost of accuracy along the studies of a case, on every engine, and names the cheapest\n"
    "settings for a wish. It makes that run and says how well error and cost were predicted. Error is\n"
    "|value| + 2 u of the metric, in its own scaled unit.\n"
    "  tripoint recommend heat/cosine-mode --error 1%\n"
    "  tripoint recommend rigid/torque-free --error 1e-5 --engines tripoint\n"
    "  tripoint recommend fluid/sound-wave --seconds 5 --from report/results.json   by earlier runs\n"
    "Exit: 0 the run met the wish, 1 it did not, 3 no settings within twice of the measured ones promise\n"
    "it.";

/// How much finer than the finest measured level a plan still names a level. An order from two or three
/// coarse levels may be off by 0.3. Over this factor that makes the error wrong by 2.
constexpr double farthest = 16.0;

constexpr const char* plan_description =
    "Predicts the level, walkers and CPU seconds that a wished error takes, with the interval of the\n"
    "measured levels. Only the two or three coarsest levels of each study are run; nothing is with\n"
    "--from. A level more than 16 times finer than the measured ones is not offered.\n"
    "  tripoint plan heat/cosine-mode --error 1%\n"
    "  tripoint plan heat/step-walkers --error 0.5% --metric uncertainty";

struct RecommendOptions {
  std::string what, error, metric, engines, from, axis, out;
  std::vector<double> levels;
  double seconds = 0.0;
  int jobs = 1, threads = 1;
  bool json = false, sandbox = false;
};

double wish_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string rest = end;
  if (end == text.c_str() || !(value > 0.0) || !std::isfinite(value) || (!rest.empty() && rest != "%"))
    throw InputError(text + ": write an error above 0, as 0.01 or 1%");
  return rest.empty() ? value : 0.01 * value;
}

Case case_of(const RecommendOptions& o) {
  CaseFilter filter;
  filter.what = {o.what};
  auto cases = select_cases(filter);
  if (cases.size() != 1) throw InputError(o.what + ": names more than one case");
  auto value = std::move(cases.front());
  value.gates.clear();
  value.inputs.clear();
  if (!o.levels.empty()) {
    Study study;
    study.axes.axis = o.axis.empty() ? Axis::spacing : from_word<Axis>(o.axis);
    study.levels = o.levels;
    study.metric = o.metric;
    value.studies = {study};
  }
  if (!o.axis.empty())
    std::erase_if(value.studies, [&](const Study& s) { return to_string(s.axes.axis) != o.axis; });
  if (value.studies.empty())
    throw InputError(o.what +
                     ": has no study to read a front from: name --axis and --levels a,b,c, coarse to fine");
  return value;
}

std::string metric_of(const RecommendOptions& o, const Case& value) {
  if (!o.metric.empty()) return o.metric;
  for (const auto& s : value.studies)
    if (!s.metric.empty()) return s.metric;
  if (value.metrics.empty()) throw InputError(value.id + ": has no metric");
  return value.metrics.front().name;
}

CaseResult measure(const RecommendOptions& o, const Case& value,
                   const std::function<bool(const RunPlan&)>& wanted) {
  const auto words = sort_engine_words(split(o.engines));
  if (o.sandbox) sandbox_third_parties(o.out, o.jobs);
  SuiteOptions options;
  options.selection.engines = words.names;
  for (const auto& path : words.paths) options.selection.engines.push_back(ask_engine(path).name);
  options.out = o.out;
  options.jobs = o.jobs;
  options.threads = o.threads;
  options.say = [](const std::string& line) { say(line); };
  options.wanted = [&](const EnginePlan& engine, const RunPlan& run) {
    return !is_exact(engine.name) && wanted(run);
  };
  const auto engines = discover_engines(words.paths);
  for (const auto& name : options.selection.engines)
    if (!find_engine(engines, name)) throw EngineError(no_such_engine(name, engines));
  auto results = run_suite({value}, engines, options);
  if (results.cases.empty()) throw EngineError("nothing was run");
  return results.cases.front();
}

/// The runs of this case in a results.json.
CaseResult read_case_of(const std::string& path, const std::string& id) {
  for (auto& c : read_results(path).cases)
    if (c.id == id) return c;
  throw InputError(path + ": holds no case " + id);
}

bool is_coarse(const Case& value, const RunPlan& run, std::size_t count) {
  return std::any_of(value.studies.begin(), value.studies.end(), [&](const Study& s) {
    const auto at = run.levels.find({s.axes.axis});
    if (at == run.levels.end()) return false;
    for (std::size_t k = 0; k < std::min(count, s.levels.size()); ++k)
      if (same_level(s.levels[k], at->second)) return true;
    return false;
  });
}

std::string name_of(const Ladder& l) { return label_of(l.engine, l.preset) + after_blank(l.mode); }

void print_ladders(const std::vector<Ladder>& ladders, const std::string& metric) {
  print(fmt::format("measured front of {}\n  {:28} {:14} {:>12} {:>12} {:>10} {:>12}\n", metric, "engine",
                    "axis", "level", "error", "CPU s", "pairs"));
  for (const auto& l : ladders)
    for (const auto& p : l.points)
      print_line(fmt::format("  {:28} {:14} {:12.5g} {:12.4g} {:10.3g} {:12.4g}", name_of(l), l.axis, p.level,
                             p.error, p.cpu_s, p.pairs));
}

double factor_between(double a, double b) {
  return a > 0.0 && b > 0.0 ? std::max(a / b, b / a) : std::numeric_limits<double>::infinity();
}

/// The recommended run itself.
LadderPoint make_recommended(const RecommendOptions& o, Case value, const Recommendation& r,
                             const std::string& metric) {
  Study only;
  only.axes.axis = r.ladder->axis;
  only.levels = {r.level};
  only.engine = r.ladder->engine;
  only.mode = r.ladder->mode;
  for (const auto& s : value.studies)
    if (s.axes.axis == only.axes.axis && (s.engine.empty() || s.engine == only.engine) &&
        (s.mode == JudgedMode::none || s.mode == only.mode)) {
      only.jitter = s.jitter;
      only.seeds = s.seeds;
    }
  value.studies = {only};
  if (only.mode != JudgedMode::none) value.modes = {mode_from(to_string(only.mode))};
  auto chosen = o;
  chosen.engines = only.engine;
  chosen.out = o.out + "/recommended";
  const auto result = measure(chosen, value, [&](const RunPlan& run) {
    const auto at = run.levels.find(only.axes);
    return at != run.levels.end() && same_level(at->second, only.levels[0]);
  });
  for (const auto& engine : result.engines)
    for (const auto& run : engine.runs) {
      const auto v = measured(run, metric);
      if (run.status != Status::ok)
        throw EngineError(fmt::format("the recommended run is {}: {}", run.status, run.reason));
      if (engine.preset == r.ladder->preset && v)
        return {r.level, 0.0, std::abs(v->value) + 2.0 * v->uncertainty.combined(), run.cost.cpu_s,
                run.cost.pairs};
    }
  throw EngineError("the recommended run gave no value of " + metric);
}

int recommend(RecommendOptions o) {
  catch_interrupts();
  if (o.error.empty() == !(o.seconds > 0.0))
    throw InputError("recommend: give --error X or --seconds Y, one of them");
  const auto value = case_of(o);
  if (o.out.empty()) o.out = own_folder("recommend", value.id);
  const auto lock = hold_folder(o.out);
  const auto metric = metric_of(o, value);
  const auto result =
      o.from.empty() ? measure(o, value, [](const RunPlan& run) { return !run.levels.empty() || run.base; })
                     : read_case_of(o.from, value.id);
  const auto ladders = ladders_of(result, metric);
  if (!o.json) print_ladders(ladders, metric);
  const double wish = o.error.empty() ? 0.0 : wish_of(o.error);
  const auto r = o.error.empty() ? best_within(value.scene, ladders, o.seconds)
                                 : cheapest_for_error(value.scene, ladders, wish);
  if (!r) {
    print(o.json ? std::string("{\"found\": false}\n")
                 : std::string("no settings within twice of what was measured promise it\n"));
    return exit_inconclusive;
  }
  if (!o.json)
    print(
        fmt::format("recommended: {}, {} = {:.6g}\n  predicted error {:.4g} (within a factor {:.2f}), {:.3g} "
                    "CPU s (within {:.2f})\n",
                    name_of(*r->ladder), r->ladder->axis, r->level, r->error.value, r->error.factor,
                    r->cpu_s.value, r->cpu_s.factor));
  const auto made = make_recommended(o, value, *r, metric);
  const bool met = o.error.empty() ? made.cpu_s <= o.seconds : made.error <= wish;
  const double error_factor = factor_between(r->error.value, made.error),
               cpu_factor = factor_between(r->cpu_s.value, made.cpu_s);
  if (o.json)
    print(json_text(
        nlohmann::ordered_json{{"found", true},
                               {"case", value.id},
                               {"metric", metric},
                               {"engine", r->ladder->engine},
                               {"preset", r->ladder->preset},
                               {"mode", r->ladder->mode},
                               {"axis", r->ladder->axis},
                               {"level", r->level},
                               {"predicted", {{"error", r->error.value}, {"cpu_s", r->cpu_s.value}}},
                               {"measured", {{"error", made.error}, {"cpu_s", made.cpu_s}}},
                               {"met", met}},
        2));
  else
    print(fmt::format("the run: error {:.4g} (predicted to a factor {:.2f}), {:.3g} CPU s (to {:.2f}): {}\n",
                      made.error, error_factor, made.cpu_s, cpu_factor,
                      met ? "meets the wish" : "DOES NOT meet the wish"));
  return met ? exit_pass : exit_fail;
}

int plan_for(RecommendOptions o) {
  catch_interrupts();
  if (o.error.empty()) throw InputError("plan: say the error that is wished: --error X");
  const auto value = case_of(o);
  const auto metric = metric_of(o, value);
  const double wish = wish_of(o.error);
  if (o.out.empty()) o.out = own_folder("plan", value.id);
  const auto lock = hold_folder(o.out);
  const auto result = o.from.empty()
                          ? measure(o, value, [&](const RunPlan& run) { return is_coarse(value, run, 3); })
                          : read_case_of(o.from, value.id);
  const auto ladders = ladders_of(result, metric);
  print_ladders(ladders, metric);
  print(fmt::format("to bring {} within {:.3g}:\n  {:28} {:14} {:>12} {:>24} {:>24}\n", metric, wish,
                    "engine", "axis", "level", "CPU s (from..to)", "error (from..to)"));
  bool any = false;
  for (const auto& l : ladders) {
    const auto& fine = l.points.back();
    const double slope = std::log(l.points[l.points.size() - 2].error / fine.error) /
                         std::log(l.points[l.points.size() - 2].step / fine.step);
    double step = 0.0;
    for (const auto& p : l.points)
      if (p.error <= wish && step == 0.0) step = p.step;
    if (step == 0.0 && slope > 0.05) step = fine.step * std::pow(wish / fine.error, 1.0 / slope);
    if (step == 0.0) {
      print_line(
          fmt::format("  {:28} {:14} {:>12}  its error falls with no power of the level (slope {:.2f}): no "
                      "level brings it there",
                      name_of(l), l.axis, "-", slope));
      continue;
    }
    const bool upward = refines_upward(l.axis);
    if (fine.step > farthest * step) {
      print_line(
          fmt::format("  {:28} {:14} {:>12}  out of reach: its error falls as the level to the {:.2g}, which "
                      "would take {:.2g}, "
                      "{:.2g} times beyond what was measured",
                      name_of(l), l.axis, "-", slope, upward ? 1.0 / step : step, fine.step / step));
      continue;
    }
    any = true;
    const auto e = predicted_error(l, step), c = predicted_cpu(l, step);
    print_line(
        fmt::format("  {:28} {:14} {:12.5g} {:>24} {:>24}", name_of(l), l.axis, upward ? 1.0 / step : step,
                    fmt::format("{:.3g} ({:.3g}..{:.3g})", c.value, c.value / c.factor, c.value * c.factor),
                    fmt::format("{:.3g} ({:.3g}..{:.3g})", e.value, e.value / e.factor, e.value * e.factor)));
  }
  return any ? exit_pass : exit_inconclusive;
}

void add_common(CLI::App& command, RecommendOptions& o, const std::string& name) {
  command.add_option("CASE", o.what, "a case file or id")->required();
  command.add_option("--metric", o.metric, "which metric (default: that of the case's first study)");
  command.add_option("--engines", o.engines, "only these engines, A,B");
  add_sandbox_flag(command, o.sandbox);
  command.add_option("--axis", o.axis, "only this axis")->check(CLI::IsMember(axis_words()));
  command.add_option("--levels", o.levels, "levels instead of the studies', coarse to fine")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--from", o.from, "take the measurements from this results.json; run nothing for them");
  command.add_option("--out", o.out, "folder of the runs (default: report-" + name + "/CASE)");
  command.add_option("--jobs", o.jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_error_option(CLI::App& command, RecommendOptions& o) {
  command.add_option("--error", o.error, "the error that is wished, in the metric's unit or as a percentage");
}

}  // namespace

void add_recommend(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("recommend", recommend_description);
  auto o = std::make_shared<RecommendOptions>();
  add_common(*command, *o, "recommend");
  add_error_option(*command, *o);
  command->add_option("--seconds", o->seconds, "the CPU seconds that may be spent");
  command->add_flag("--json", o->json, "print one JSON document");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return recommend(*o); }); });
}

void add_plan(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("plan", plan_description);
  auto o = std::make_shared<RecommendOptions>();
  add_common(*command, *o, "plan");
  add_error_option(*command, *o);
  command
      ->add_option_function<std::string>("--within",
                                         [o](const std::string& wish) {
                                           note_earlier("--within X", "--error X");
                                           o->error = wish;
                                         })
      ->group("");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return plan_for(*o); }); });
}

}  // namespace tripoint
