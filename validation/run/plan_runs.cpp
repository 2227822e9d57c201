// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/plan_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::optional<double> number_setting(const Settings& settings, const std::string& key) {
  const auto at = settings.find(key);
  if (at == settings.end() || !std::holds_alternative<double>(at->second)) return {};
  return std::get<double>(at->second);
}

constexpr std::string_view every_engine = "all";  ///< [engines.all]: settings, no engine

/// Settings of an engine over those that all engines get.
Settings settings_of(const Case& value, const EngineChoice& engine) {
  Settings settings = engine.settings;
  for (const auto& e : value.engines)
    if (e.name == every_engine) settings.insert(e.settings.begin(), e.settings.end());
  return settings;
}

/// Whether [engines.all] asks for a law of contact that the solver does not have: it refuses friction, and
/// restitution but for 1.
bool asks_for_laws_of_contact(const Case& value) {
  const auto other = [](const Settings& settings, const char* name, double own) {
    const auto at = settings.find(name);
    return at != settings.end() && at->second != Setting(own);
  };
  return std::ranges::any_of(value.engines, [&](const auto& e) {
    return e.name == every_engine &&
           (other(e.settings, "friction", 0.0) || other(e.settings, "restitution", 1.0));
  });
}

std::vector<EngineChoice> engines_of(const Case& value, const std::vector<EngineEntry>& found,
                                     const Selection& selection) {
  std::vector<EngineChoice> list;
  const auto listed = [&](const std::string& name) {
    return std::find_if(value.engines.begin(), value.engines.end(),
                        [&](const auto& e) { return e.name == name; });
  };
  const auto add = [&](const std::string& name, bool required) {
    if (std::any_of(list.begin(), list.end(), [&](const auto& e) { return e.name == name; })) return;
    const auto at = listed(name);
    auto choice = at == value.engines.end() ? EngineChoice{name, required, false, {}, {}} : *at;
    choice.required = choice.required || required;
    list.push_back(choice);
  };
  add(engine_name::solver,
      listed(engine_name::solver) == value.engines.end() && !asks_for_laws_of_contact(value));
  for (const auto& e : value.engines)
    if (e.name != every_engine) add(e.name, false);
  if (has_states(value.reference)) add(engine_name::exact, false);
  for (const auto& name : selection.extra) add(name, false);
  for (const auto& name : selection.engines) add(name, false);
  for (const auto& e : found)
    if (e.joins) add(e.name, false);
  if (!selection.engines.empty())
    std::erase_if(list, [&](const auto& e) {
      return !contains(selection.engines, e.name) && !contains(selection.extra, e.name);
    });
  return list;
}

/// The value that the case's own resolution has on an axis.
std::optional<double> own_level(const Scene& scene, const RunPlan& run, Axis axis) {
  switch (axis) {
    case Axis::spacing:
      return scene.spacing;
    case Axis::time_step:
      return scene.time_step;
    case Axis::support_ratio:
      return scene.support_ratio;
    case Axis::walkers:
      return run.walkers;
    case Axis::iterations:
      break;
  }
  return run.iterations;
}

/// Whether an engine says in --info that it has settings, and has none of the study's number: its own run is
/// then the finest level.
bool lacks_number(const EngineEntry* entry, Axis axis) {
  if (!entry || entry->settings.empty() || is_own_solver(entry->name)) return false;
  return (axis == Axis::walkers || axis == Axis::iterations) &&
         !entry->settings.contains(std::string(to_string(axis)));
}

void set_level(RunPlan& run, Axis axis, double level) {
  switch (axis) {
    case Axis::spacing:
      run.choice.spacing = level;
      return;
    case Axis::time_step:
      run.choice.time_step = level;
      return;
    case Axis::support_ratio:
      run.choice.support_ratio = level;
      return;
    case Axis::walkers:
      run.walkers = level;
      return;
    case Axis::iterations:
      run.iterations = level;
  }
}

/// "paper-": how the labels of a mode's runs begin.
std::string label_start(JudgedMode mode) {
  return mode == JudgedMode::none ? std::string() : std::string(to_string(mode)) + "-";
}

/// Runs in the order in which they are made. A run is compared only with those of its mode, jitter and seed,
/// by numbers that its scene gave once. Each seed of a study is a run, and comparing all of them would take
/// millions of scenes.
class RunList {
 public:
  explicit RunList(const Case& value) : case_(value) {}

  /// Also where the same run was planned before. A run with an input of its own is never compared: no study
  /// has another like it.
  void append(const RunPlan& run) {
    if (run.input.empty()) {
      const auto [key, numbers] = told_apart(run);
      alike_[key].push_back({numbers, runs_.size()});
    }
    runs_.push_back(run);
  }

  /// @return group of the run, or of the one that is the same and was planned before
  std::string add(const RunPlan& run) {
    const auto [key, numbers] = told_apart(run);
    auto& alike = alike_[key];
    const auto at = std::find_if(alike.begin(), alike.end(),
                                 [&n = numbers](const Placed& p) { return same(p.numbers, n); });
    if (at != alike.end()) {
      RunPlan& before = runs_[at->place];
      before.levels.insert(run.levels.begin(), run.levels.end());
      return before.group;
    }
    alike.push_back({numbers, runs_.size()});
    return runs_.emplace_back(run).group;
  }

  [[nodiscard]] std::vector<RunPlan> take() { return std::move(runs_); }

 private:
  using Key = std::tuple<JudgedMode, double, std::uint64_t>;  // mode, jitter, seed
  using Numbers = std::array<std::optional<double>, 5>;
  struct Placed {
    Numbers numbers;
    std::size_t place;
  };

  [[nodiscard]] std::pair<Key, Numbers> told_apart(const RunPlan& run) const {
    const Scene s = scene_of(case_, run);
    return {{run.mode, s.jitter, s.seed},
            {s.spacing, s.time_step, s.support_ratio, run.walkers, run.iterations}};
  }

  static bool same(const Numbers& a, const Numbers& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
      return x.has_value() == y.has_value() && (!x || same_level(*x, *y));
    });
  }

  const Case& case_;
  std::vector<RunPlan> runs_;
  std::map<Key, std::vector<Placed>> alike_;
};

void set_together(RunPlan& run, const Study& study, std::size_t k) {
  if (!study.support_ratios.empty()) set_level(run, Axis::support_ratio, study.support_ratios[k]);
  if (!study.time_steps.empty()) set_level(run, Axis::time_step, study.time_steps[k]);
}

void add_study(const Study& study, const RunPlan& base, std::uint64_t seed, RunList& runs) {
  for (std::size_t k = 0; k < study.levels.size(); ++k) {
    const double level = study.levels[k];
    auto run = base;
    run.base = false;
    run.levels = {{study.axes, level}};
    set_level(run, study.axes.axis, level);
    set_together(run, study, k);
    if (study.jitter > 0.0) run.choice.jitter = study.jitter;
    run.label = run.group = fmt::format("{}{}={:g}{}", label_start(base.mode), to_string(study.axes), level,
                                        study.jitter > 0.0 ? fmt::format("-jitter={:g}", study.jitter) : "");
    const std::string group = runs.add(run);
    for (int n = 1; n < study.seeds; ++n) {
      auto replica = run;
      replica.choice.seed = seed + static_cast<std::uint64_t>(n);
      replica.group = group;
      replica.label += fmt::format("-seed{}", *replica.choice.seed);
      static_cast<void>(runs.add(replica));
    }
  }
}

/// The case's own run at both ends of each uncertain input.
void add_inputs(const Case& value, const RunPlan& base, RunList& runs) {
  for (const auto& input : value.inputs)
    for (const auto& [end, what] : {std::pair{"low", input.low}, std::pair{"high", input.high}}) {
      auto run = base;
      run.base = false;
      run.input = input.key + "=" + what;
      run.label = run.group = fmt::format("{}{}-{}", label_start(base.mode), input.key, end);
      runs.append(run);
    }
}

std::vector<JudgedMode> modes_of(const Case& value, const EngineChoice& engine) {
  if (!is_own_solver(engine.name)) return {JudgedMode::none};
  std::vector<JudgedMode> modes;
  for (const auto mode : value.modes) modes.push_back(from_word<JudgedMode>(to_string(mode)));
  return modes;
}

std::vector<std::string> presets_of(const EngineChoice& engine, const EngineEntry* entry) {
  if (!engine.presets.empty()) return engine.presets;
  return {entry && !contains(entry->presets, default_preset) ? entry->presets.front() : default_preset};
}

/// Counts the runs of a case before any of them is planned.
class Budget {
 public:
  void spend(std::size_t runs, const SourcePlace& place) {
    asked_ += runs;
    if (asked_ > most_runs)
      throw InputError(
          place,
          fmt::format(
              "here the case asks for {} runs by now, more than the {} that can be planned: give fewer "
              "levels, seeds, modes, presets or engines",
              asked_, most_runs));
  }

 private:
  std::size_t asked_ = 0;
};

void count_runs(const Case& value, const EngineChoice& engine, const EngineEntry* entry, std::size_t presets,
                Budget& budget) {
  for (const JudgedMode mode : modes_of(value, engine)) {
    budget.spend(presets, {value.file, 0, 0});
    for (const auto& input : value.inputs) budget.spend(2 * presets, input.place);
    for (const auto& study : value.studies)
      if (applies(study, engine.name, mode) && !lacks_number(entry, study.axes.axis))
        budget.spend(presets * study.levels.size() * static_cast<std::size_t>(study.seeds), study.place);
  }
}

std::vector<RunPlan> runs_of(const Case& value, const EngineChoice& engine, const EngineEntry* entry,
                             const Selection& selection) {
  RunList runs(value);
  const std::uint64_t seed = selection.seed.value_or(value.scene.seed);
  for (const JudgedMode mode : modes_of(value, engine)) {
    RunPlan base;
    base.mode = mode;
    base.base = true;
    if (mode != JudgedMode::none) base.choice.mode = mode_from(to_string(mode));
    base.choice.seed = seed;
    base.walkers = number_setting(engine.settings, "walkers");
    base.iterations = number_setting(engine.settings, "iterations");
    base.label = base.group = mode == JudgedMode::none ? "base" : to_string(mode);
    const Scene scene = scene_of(value, base);
    for (const auto& study :
         // a gate on this level means the case's own run too, whichever engine the study is of
         value.studies)
      if (const auto level = own_level(scene, base, study.axes.axis); level && study.axes.alone())
        base.levels[study.axes] = *level;
      else if (applies(study, engine.name, mode) && lacks_number(entry, study.axes.axis))
        base.levels[study.axes] = study.levels.back();
    runs.append(base);
    base.levels.clear();
    if (!is_exact(engine.name)) add_inputs(value, base, runs);
    for (const auto& study : value.studies)
      if (applies(study, engine.name, mode) && !lacks_number(entry, study.axes.axis))
        add_study(study, base, seed, runs);
  }
  return runs.take();
}

}  // namespace

bool has_states(const ReferenceChoice& reference) {
  // a field of place, not of particles
  if (reference.function == "expression" || reference.function == "table") return false;
  return !reference.function.empty() &&
         (reference.kind == ReferenceKind::analytic || reference.kind == ReferenceKind::discrete_exact ||
          reference.kind == ReferenceKind::mms);
}

std::vector<EnginePlan> plan_runs(const Case& value, const std::vector<EngineEntry>& found,
                                  const Selection& selection) {
  std::vector<EnginePlan> plans;
  Budget budget;
  for (const auto& engine : engines_of(value, found, selection)) {
    EnginePlan plan;
    plan.name = engine.name;
    plan.required = engine.required;
    plan.settings = settings_of(value, engine);
    plan.entry = find_engine(found, engine.name);
    const auto presets = presets_of(engine, plan.entry);
    if (!plan.entry || plan.entry->available) {
      count_runs(value, engine, plan.entry, presets.size(), budget);
      plan.runs = runs_of(value, engine, plan.entry, selection);
    }
    for (const auto& preset : presets) {
      plan.preset = preset;
      plans.push_back(plan);
    }
  }
  return plans;
}

Scene scene_of(const Case& value, const RunPlan& run) {
  return scene_for(run.input.empty() ? value : read_case(value.file, {run.input}).value, run.choice);
}

}  // namespace tripoint
