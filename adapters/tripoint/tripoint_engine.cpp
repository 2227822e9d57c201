// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/tripoint/tripoint_engine.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scene/nearest.hpp"

namespace tripoint {
namespace {

template <class T>
T setting(const Job& job, const std::string& name, T otherwise) {
  const auto place = job.settings.find(name);
  if (place == job.settings.end()) return otherwise;
  const T* value = std::get_if<T>(&place->second);
  if (!value) throw InputError("the setting " + name + " of the engine tripoint has the wrong kind of value");
  return *value;
}

constexpr std::string_view no_squish = "no_squish-";  ///< followed by the axes, outer to inner: no_squish-012

/// The order of axes that a preset names. @throws InputError for a preset that is not listed by info()
std::optional<std::array<std::size_t, 3>> axis_order_of(const std::string& preset) {
  if (preset == "default") return {};
  const std::string axes = preset.starts_with(no_squish) ? preset.substr(no_squish.size()) : "";
  std::string sorted = axes;
  std::ranges::sort(sorted);
  if (sorted != "012")
    throw InputError("the engine tripoint has no preset " + preset +
                     ": default or no_squish- and the order of axes, as in no_squish-012");
  return std::array{static_cast<std::size_t>(axes[0] - '0'), static_cast<std::size_t>(axes[1] - '0'),
                    static_cast<std::size_t>(axes[2] - '0')};
}

SimulationOptions options_of(const Job& job) {
  SimulationOptions options;
  options.threads = job.threads;
  options.gives_way = true;
  options.force_time_step = setting(job, "force_time_step", false);
  options.axis_order = axis_order_of(job.preset);
  options.skin = setting(job, "skin", options.skin);
  if (!(options.skin >= 0.0 && options.skin <= 2.0)) throw InputError("the setting skin of the engine tripoint is from 0 to 2 support radii");
  options.lanes = static_cast<int>(setting(job, "lanes", 0.0));
  return options;
}

Scene scene_of(const Job& job) {
  Scene scene = job.scene;
  if (job.resolution.time_step) scene.time_step = job.resolution.time_step;
  return scene;
}

/// A setting that nobody reads would be ignored in silence. @return why not, or empty
std::string refuse_settings(const Job& job, const EngineInfo& info) {
  std::vector<std::string> known{"wall_limit", "walkers", "iterations"};  // the harness's own, and axes of studies that all engines take part in
  for (const auto& [name, meaning] : info.settings) known.push_back(name);
  for (const auto& [name, value] : job.settings) {
    if (std::ranges::find(known, name) != known.end()) continue;
    if (name == "restitution") {  // of all engines: contact is the gradient of an energy, which gives back what it took
      if (const double* e = std::get_if<double>(&value); e && *e == 1.0) continue;
      return "tripoint: contact in the particle model is elastic by its energy: restitution is no setting, and only 1 is what it does";
    }
    if (name.find("friction") != std::string::npos)
      return "tripoint: the particle model meets by pressure and viscosity alone and has no law of Coulomb: " + name + " is no setting; scene.contact_viscosity brakes solids that slide on each other";
    return "tripoint: no setting is named " + printable(name) + suggestion(name, known);
  }
  return {};
}

}  // namespace

EngineInfo TripointEngine::info() const {
  EngineInfo info;
  info.name = "tripoint";
  info.version = TRIPOINT_VERSION;
  info.build = TRIPOINT_BUILD;
  std::error_code ignored;
  info.library_path = std::filesystem::read_symlink("/proc/self/exe", ignored).string();  // the solver is this program
  info.capabilities = {"rigid-free-flight", "gravity",  "merge", "split",     "release", "hold",
                       "prescribed",        "periodic", "heat",  "heat-held", "paper",   "corrected", "restart",
                       "liquid", "contact", "viscosity", "walls", "transport-velocity", "elastic", "phase"};
  info.presets = {"default"};
  for (const char* axes : {"012", "021", "102", "120", "201", "210"}) info.presets.push_back(std::string(no_squish) + axes);
  info.settings = {{"force_time_step", "true runs with the scene's time_step though it is above a bound; default false"},
                   {"skin", "skin of the neighbour lists in support radii; default 0.1"},
                   {"lanes", "particles that pair passes work on at once: 1, 4 (AVX2) or 8 (AVX-512); they change no bit; default what is fastest"},
                   {"checkpoint_interval", "seconds of simulated time between checkpoints; they change no bit; default none"}};
  info.deterministic = true;
  info.defects = registered_defects();
  return info;
}

std::string TripointEngine::refusal(const Job& job) const {
  if (const std::string missing = missing_effect(job.scene); !missing.empty())
    return "tripoint: the " + missing + " effect is not in this build";
  if (job.ranks != 1) return "tripoint: runs in one process, ranks = " + std::to_string(job.ranks) + " is not possible";
  return refuse_settings(job, info());
}

std::string TripointEngine::trial(const Job& job) const {
  try {
    const Simulation probe(scene_of(job), read_particles(job.particles), options_of(job));
    return {};
  } catch (const InputError& e) {
    return std::string("tripoint: ") + e.what();
  } catch (const Diverged&) {
    return {};  // a case may be meant to diverge: the run says where
  }
}

void TripointEngine::load(const Job& job, const InitialState& initial) {
  simulation_.emplace(scene_of(job), initial, options_of(job));
}

void TripointEngine::advance_to(double time) { simulation_->advance_to(time); }

void TripointEngine::resume(const Job& job, const InitialState& initial, const Checkpoint& kept) {
  simulation_.emplace(scene_of(job), initial, options_of(job), kept);
}

bool TripointEngine::advance_to(double time, const std::function<bool(double, long)>& go_on) {
  return simulation_->advance_to(time, [&] { return go_on(simulation_->world().time, simulation_->steps()); });
}

void TripointEngine::save(Checkpoint& kept) const { kept = simulation_->checkpoint(); }

Snapshot TripointEngine::observe() const { return snapshot_of(*simulation_); }

Readback TripointEngine::readback() const {
  const World& world = simulation_->world();
  Readback held;
  held.gravity = world.scene.gravity;
  held.time_step = world.scene.time_step.value_or(simulation_->bound().dt);
  const auto of_scene = static_cast<std::size_t>(std::ranges::count_if(world.scene.bodies, [](const Body& b) { return b.phase != Phase::liquid; }));
  for (std::size_t b = 0; b < of_scene; ++b) {  // what is cold from the start has frozen to bodies of its own by now
    held.bodies.push_back({world.body_names[b], world.bodies[field::body_mass][b], world.bodies[field::body_centre][b],
                           world.bodies[field::body_inertia][b], 0.0, 0.0, 0.0, 0.0});
  }
  return held;
}

std::string TripointEngine::show_failure(const Diverged& failure, const std::string& folder) const {
  if (!simulation_) return {};
  constexpr const char* name = "culprits.vtp";
  write_vtp(folder + "/" + name, culprits_of(simulation_->world(), failure));
  return name;
}

void TripointEngine::account(Result& result) const {
  if (!simulation_) return;
  result.steps = simulation_->steps();
  result.pairs = simulation_->pairs();
  result.time_step_bound = simulation_->time_step_set_by();
  result.extra["time_step"] = simulation_->time_step();
  if (std::isfinite(simulation_->bound().dt)) result.extra["time_step_bound"] = simulation_->bound().dt;
  if (const Recovery& recovery = simulation_->recovery(); recovery.count() > 0) {
    result.extra["recoveries"] = static_cast<double>(recovery.count());
    if (result.message.empty()) result.message = "recovered " + std::to_string(recovery.count()) + (recovery.count() == 1 ? " time" : " times") + ", last when " + recovery.last();
  }
  if (const auto& lists = simulation_->world().neighbours)
    result.extra["neighbour_rebuilds"] = static_cast<double>(lists->rebuilds());
}

}  // namespace tripoint
