// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/tripoint/tripoint_engine.hpp"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "adapters/tripoint/solver_job.hpp"
#include "scene/meeting.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

/// A setting that nobody reads would be ignored in silence. @return why not, or empty
std::string refuse_settings(const Job& job, const EngineInfo& info) {
  std::vector<std::string> known{"wall_limit", "walkers",
                                 // The harness's own, and axes of studies that all engines take part in
                                 "iterations"};
  for (const auto& [name, meaning] : info.settings) known.push_back(name);
  for (const auto& [name, value] : job.settings) {
    if (std::ranges::find(known, name) != known.end()) continue;
    if (name == "friction" || name == "restitution") {
      // Where all pairs have one law it comes as a setting too
      const double* number = std::get_if<double>(&value);
      if (!job.scene.contact_laws.empty() || (number && *number == (name == "friction" ? 0.0 : 1.0)))
        continue;
      return "tripoint: the particle solver has " + name +
             " by pairs of materials: write a [[contact]] of the scene, for all engines";
    }
    return "tripoint: no setting is named " + printable(name) + suggestion(name, known);
  }
  return {};
}

constexpr double half_turn = std::numbers::pi;

/// What the step has no form of.
std::string refuse_joints(const Scene& scene) {
  for (const Joint& j : scene.joints) {
    if (j.kind == Joint::Kind::hinge && j.limits && !(std::max(-(*j.limits)[0], (*j.limits)[1]) < half_turn))
      return "limits of a hinge are simulated within half a turn, and joint " + j.name + " has others";
    const bool of_two = j.bodies[0] != "world" && j.bodies[1] != "world";
    if (of_two && scene.contact && !meetings(scene).empty())
      return "bodies with a joint would touch each other where others touch: write scene.contact = \"none\"";
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
  // The solver is this program
  info.library_path = std::filesystem::read_symlink("/proc/self/exe", ignored).string();
  info.capabilities = {"rigid-free-flight",
                       "gravity",
                       "merge",
                       "split",
                       "release",
                       "hold",
                       "prescribed",
                       "periodic",
                       "heat",
                       "heat-held",
                       "paper",
                       "corrected",
                       "restart",
                       "liquid",
                       "contact",
                       "contact-pairs",
                       "force",
                       "source",
                       "outflow",
                       "spring",
                       "joint",
                       "torque",
                       "viscosity",
                       "walls",
                       "transport-velocity",
                       "elastic",
                       "phase",
                       "surface-temperature",
                       "plane"};
  info.presets = {"default"};
  for (const char* axes : {"012", "021", "102", "120", "201", "210"})
    info.presets.push_back(std::string(no_squish) + axes);
  info.settings = {
      {"force_time_step", "true runs with the scene's time_step though it is above a bound; default false"},
      {"skin", "skin of the neighbour lists in support radii; default 0.1"},
      {"lanes",
       "particles that pair passes work on at once: 1, 4 (AVX2) or 8 (AVX-512); they change no bit; default "
       "what is fastest"},
      {"checkpoint_interval",
       "seconds of simulated time between checkpoints; they change no bit; default none"}};
  info.deterministic = true;
  return info;
}

std::string TripointEngine::refusal(const Job& job) const {
  if (const std::string missing = missing_effect(job.scene); !missing.empty())
    return "tripoint: the " + missing + " effect is not in this build";
  if (const std::string why = refuse_joints(job.scene); !why.empty()) return "tripoint: " + why;
  if (job.ranks != 1)
    return "tripoint: runs in one process, ranks = " + std::to_string(job.ranks) + " is not possible";
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
  simulation_ = std::make_unique<Simulation>(scene_of(job), initial, options_of(job));
}

void TripointEngine::advance_to(double time) { simulation_->advance_to(time); }

void TripointEngine::resume(const Job& job, const InitialState& initial, const Checkpoint& kept) {
  simulation_ = std::make_unique<Simulation>(scene_of(job), initial, options_of(job), kept);
}

bool TripointEngine::advance_to(double time, const std::function<bool(double, long)>& go_on) {
  return simulation_->advance_to(time,
                                 [&] { return go_on(simulation_->state().time, simulation_->steps()); });
}

void TripointEngine::save(Checkpoint& kept) const { kept = simulation_->checkpoint(); }

Snapshot TripointEngine::observe() const { return snapshot_of(*simulation_); }

Readback TripointEngine::readback() const { return readback_of(simulation_->state(), simulation_->bound()); }

std::string TripointEngine::show_failure(const Diverged& failure, const std::string& folder) const {
  if (!simulation_) return {};
  constexpr const char* name = "culprits.vtp";
  write_vtp(folder + "/" + name, culprits_of(simulation_->state(), failure));
  return name;
}

void TripointEngine::account(Result& result) const {
  if (!simulation_) return;
  result.steps = simulation_->steps();
  result.pairs = simulation_->pairs();
  result.time_step_bound = simulation_->time_step_set_by();
  result.extra["time_step"] = simulation_->time_step();
  if (std::isfinite(simulation_->bound().dt)) result.extra["time_step_bound"] = simulation_->bound().dt;
  report_recoveries(simulation_->recovery(), result);
  report_left(simulation_->state(), result);
  if (const auto& lists = simulation_->state().neighbours)
    result.extra["neighbour_rebuilds"] = static_cast<double>(lists->rebuilds());
}

}  // namespace tripoint
