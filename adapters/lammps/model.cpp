// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

namespace tripoint::lammps {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& what) {
  throw InputError(fmt::format("lammps: the setting {} must be {}", key, what));
}
double positive(const std::string& key, const Setting& value) {
  const auto* d = std::get_if<double>(&value);
  if (!d || !(*d > 0.0)) refuse(key, "a number above zero");
  return *d;
}
std::string text(const std::string& key, const Setting& value) {
  const auto* s = std::get_if<std::string>(&value);
  if (!s) refuse(key, "a text");
  return *s;
}

struct Entry {
  std::string help;
  std::function<void(Choice&, const std::string&, const Setting&)> apply;
};

const std::map<std::string, Entry>& entries() {
  static const std::map<std::string, Entry> table{
      {"conduction",
       {"heat by brownian | langevin (walkers) | sph (pair sph/heatconduction) | rheo; default: rheo where "
        "matter changes phase, "
        "else the preset, then brownian where the build has it, else langevin",
        [](Choice& c, const std::string& k, const Setting& v) {
          c.conduction = text(k, v);
          if (c.conduction != "brownian" && c.conduction != "langevin" && c.conduction != "sph" &&
              c.conduction != "rheo")
            refuse(k, "brownian, langevin, sph or rheo");
        }}},
      {"walkers",
       {"number of walkers, default 1e5; the job's resolution.walkers goes first",
        [](Choice& c, const std::string& k, const Setting& v) { c.walkers = positive(k, v); }}},
      {"cutoff",
       {"support of the pair styles in spacings; default: sph/heatconduction 3, sph/taitwater the scene's, "
        "smd/tlsph 2.01, rheo "
        "3",
        [](Choice& c, const std::string& k, const Setting& v) { c.cutoff = positive(k, v); }}},
      {"pool",
       {"count walkers in whole layers where the start depends on one coordinate only, default true",
        [](Choice& c, const std::string& k, const Setting& v) {
          const auto* b = std::get_if<bool>(&v);
          if (!b) refuse(k, "true or false");
          c.pool = *b;
        }}},
      {"freezing",
       {"rheo: t_melt | t_solid, the one temperature at which matter that has two both melts and freezes; "
        "default none, and such "
        "a scene is refused",
        [](Choice& c, const std::string& k, const Setting& v) {
          c.freezing = text(k, v);
          if (c.freezing != "t_melt" && c.freezing != "t_solid") refuse(k, "t_melt or t_solid");
        }}},
      {"rigid_modulus",
       {"rheo: Young's modulus in Pa of the bonds that stand in for matter that is rigid when solid; default "
        "none, and such a "
        "scene is refused",
        [](Choice& c, const std::string& k, const Setting& v) { c.rigid_modulus = positive(k, v); }}},
      {"sound_speed",
       {"rheo: speed of sound of the liquid in m/s, default the scene's",
        [](Choice& c, const std::string& k, const Setting& v) { c.sound_speed = positive(k, v); }}},
      {"commands",
       {"LAMMPS commands run after the set-up, default none",
        [](Choice& c, const std::string& k, const Setting& v) { c.commands = text(k, v); }}},
      {"time_step",
       {"rigid: default 1/240 s; sph heat: 0.1 dx2/D; liquids: 0.06 h/c and 0.1 dx2/nu; elastic: 0.2 h/c_L; "
        "walkers take only "
        "this one, not the job's, default as long as the box allows",
        [](Choice&, const std::string& k, const Setting& v) { (void)positive(k, v); }}}};
  return table;
}

/// A preset and how it conducts heat; nothing = as the library's default does.
struct Preset {
  std::string_view name, conduction;
};
constexpr std::array<Preset, 3> presets{{{"default", ""}, {"walkers", ""}, {"conduction", "sph"}}};

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : presets) names.emplace_back(preset.name);
  return names;
}

std::map<std::string, std::string> setting_help() {
  std::map<std::string, std::string> help;
  for (const auto& [key, entry] : entries()) help[key] = entry.help;
  return help;
}

Choice choice_for(const Job& job) {
  Choice choice;
  const auto preset = std::ranges::find(presets, job.preset, &Preset::name);
  if (preset == presets.end())
    throw InputError(
        fmt::format("lammps: no preset '{}'; there are {}", job.preset, fmt::join(preset_names(), ", ")));
  choice.conduction = preset->conduction;
  for (const auto& [key, value] : job.settings) {
    const auto entry = entries().find(key);
    if (entry == entries().end())
      throw InputError(fmt::format("lammps: no setting '{}'; --info lists them", key));
    entry->second.apply(choice, key, value);
  }
  if (job.resolution.walkers) choice.walkers = *job.resolution.walkers;
  return choice;
}

std::optional<double> wanted_time_step(const Job& job) {
  const auto set = job.settings.find("time_step");
  if (set == job.settings.end()) return job.resolution.time_step;
  return positive("time_step", set->second);
}

void Clock::run(Library& library, const Steps& steps) {
  const bool same = std::abs(steps.size - size_) <= 1e-12 * steps.size;
  if (!same) library.run(fmt::format("timestep {:.17g}", steps.size));
  library.run(fmt::format("run {} pre {} post no", steps.count, same ? "no" : "yes"));
  size_ = steps.size;
  total_ += steps.count;
}

}  // namespace tripoint::lammps
