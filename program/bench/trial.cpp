// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/trial.hpp"

#include <fmt/format.h>

#include <exception>

#include "program/bench/clock.hpp"
#include "program/bench/memory.hpp"
#include "sampling/sample.hpp"
#include "step/simulation.hpp"

namespace tripoint::bench {
namespace {

void take_steps(Trial& trial, const Scene& scene, long steps, int threads, std::size_t most) {
  const InitialState initial = sample(scene);
  trial.particles = initial.size();
  if (initial.size() > most)
    throw InputError(fmt::format("{} particles, more than {}", initial.size(), most));
  restart_peak();
  const double before = resident_bytes();
  StageSeconds stages{};
  SimulationOptions how;
  how.threads = threads;
  how.stage_seconds = &stages;
  const auto start = Clock::now();
  Simulation simulation(scene, initial, how);
  trial.setup_seconds = since(start);
  stages.fill(0.0);
  const auto begin = Clock::now();
  long left = steps;
  simulation.advance_to(scene.end_time, [&] { return --left > 0; });
  const double took = since(begin);
  trial.steps = simulation.steps();
  trial.bytes = (peak_bytes() - before) / static_cast<double>(initial.size());
  if (trial.steps == 0) return;
  const auto n = static_cast<double>(trial.steps);
  trial.step_seconds = took / n;
  for (std::size_t k = 0; k < stages.size(); ++k) trial.stages[k] = stages[k] / n;
  trial.time_step = simulation.time_step();
  trial.bound_by = simulation.time_step_set_by();
  trial.run_steps = n + (scene.end_time - simulation.state().time) / trial.time_step;
}

}  // namespace

Trial try_scene(const Scene& scene, long steps, int threads, std::size_t most) {
  Trial trial;
  try {
    take_steps(trial, scene, steps, threads, most);
  } catch (const std::exception& e) {  // a scene that is meant to fail, or that this build cannot run
    trial.failure = e.what();
  }
  return trial;
}

}  // namespace tripoint::bench
