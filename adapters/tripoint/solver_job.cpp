// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/tripoint/solver_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/contact_law.hpp"
#include "state/left_numbers.hpp"

namespace tripoint {
namespace {

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

}  // namespace

SimulationOptions options_of(const Job& job) {
  SimulationOptions options;
  options.threads = job.threads;
  options.gives_way = true;
  options.force_time_step = setting(job, "force_time_step", false);
  options.axis_order = axis_order_of(job.preset);
  options.skin = setting(job, "skin", options.skin);
  if (!(options.skin >= 0.0 && options.skin <= 2.0))
    throw InputError("the setting skin of the engine tripoint is from 0 to 2 support radii");
  options.lanes = static_cast<int>(setting(job, "lanes", 0.0));
  return options;
}

Scene scene_of(const Job& job) {
  Scene scene = job.scene;
  if (job.resolution.time_step) scene.time_step = job.resolution.time_step;
  return scene;
}

Readback readback_of(const State& state, const TimeStepBound& bound) {
  Readback held;
  held.gravity = state.scene.gravity;
  held.time_step = state.scene.time_step.value_or(bound.dt);
  const auto of_scene = static_cast<std::size_t>(
      std::ranges::count_if(state.scene.bodies, [](const Body& b) { return b.phase != Phase::liquid; }));
  const CommonContact common = common_contact(state.scene);
  const bool rubs = !state.scene.contact_laws.empty();
  // Matter that is cold from the start has frozen to bodies of its own by now
  for (std::size_t b = 0; b < of_scene; ++b) {
    held.bodies.push_back({state.body_names[b], state.bodies[field::body_mass][b],
                           state.bodies[field::body_centre][b], state.bodies[field::body_inertia][b],
                           common.friction.value_or(0.0), common.restitution.value_or(rubs ? 0.0 : 1.0), 0.0,
                           0.0});
  }
  return held;
}

void report_recoveries(const Recovery& recovery, Result& result) {
  if (recovery.count() == 0) return;
  result.extra["recoveries"] = static_cast<double>(recovery.count());
  if (result.message.empty())
    result.message = "recovered " + std::to_string(recovery.count()) +
                     (recovery.count() == 1 ? " time" : " times") + ", last when " + recovery.last();
}

void report_left(const State& state, Result& result) {
  if (!state.particles.has(field::number)) return;
  const StepNumbers& n = state.step_numbers;
  using namespace left_numbers;
  for (const auto& [name, number] : {std::pair{"left", left},
                                     {"mass_left", mass},
                                     {"momentum_left_x", px},
                                     {"momentum_left_y", py},
                                     {"momentum_left_z", pz}})
    result.extra[name] = n[number];
  if (n[left] > 0.0 && result.message.empty())
    result.message = fmt::format("{:.0f} particles of {:.0f} have left the scene, with {:.4g} kg", n[left],
                                 n[ever], n[mass]);
}

}  // namespace tripoint
