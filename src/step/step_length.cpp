// SPDX-License-Identifier: BSD-3-Clause
#include "step/step_length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "step/each_effect.hpp"
#include "step/guard.hpp"

namespace tripoint {
namespace {

/// Share of a step that counts as round-off [1]: a choice, far above the 1e-16 of a division and far below
/// any real change.
constexpr double rounding = 1e-9;

}  // namespace

TimeStepBound least_bound(const State& state, const std::vector<Active>& effects) {
  TimeStepBound least;
  for_each_effect(state, effects, [&](const Effect& effect) {
    const TimeStepBound bound = effect.max_dt(state);
    tighten(least, bound.dt, bound.name);
  });
  if (state.halo) state.halo->take_least(least.dt, least.name);
  return least;
}

long steps_to(const State& state, double time, const TimeStepBound& bound, double share) {
  const auto& given = state.scene.time_step;
  const double length = time - state.time, most = share * given.value_or(bound.dt);
  if (length > most_steps * most) refuse_small_step(state, most, length, given ? "scene" : bound.name);
  return std::max(1L, static_cast<long>(std::ceil(length / most - rounding)));
}

void refuse_above_bound(const State& state, double step, const TimeStepBound& bound, bool begun) {
  if (step <= bound.dt * (1.0 + rounding)) return;
  if (begun) refuse_step(state, step, bound.dt, bound.name);
  throw InputError(fmt::format(
      "time_step {:.4g} s is above the bound of {}, {:.4g} s: make it smaller, or run all the same with "
      "[engines.tripoint] settings = {{ force_time_step = true }}",
      step, bound.name, bound.dt));
}

void refuse_endless_run(const Scene& scene, const TimeStepBound& first) {
  const double step = scene.time_step.value_or(first.dt);
  if (scene.end_time <= most_steps * step) return;
  throw InputError(fmt::format(
      "the run would take {:.3g} steps: its first step is {:.3g} s, set by {}, and it ends at {:.3g} s; at "
      "most "
      "{:.0e} can be made",
      scene.end_time / step, step, scene.time_step ? "the scene" : first.name, scene.end_time, most_steps));
}

}  // namespace tripoint
