// SPDX-License-Identifier: BSD-3-Clause
#include "step/settle.hpp"

#include <algorithm>
#include <cmath>

#include "core/counter_noise.hpp"
#include "core/errors.hpp"
#include "sampling/lattice.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

bool (*stop_wanted)() noexcept = nullptr;

bool is_stopped() noexcept { return stop_wanted && stop_wanted(); }

constexpr double rest = 2e-3;                 ///< of sqrt(g H), rms: a tenth of the limit for still water
constexpr double shaken = 0.05;               ///< spacings, to either side
constexpr long most_settling_steps = 20'000;  ///< tanks 5 to 10 across take 4,000 to 10,000
/// One after the other below `rest`: single low peaks come of the fastest swings
constexpr int calm_cycles = 5;

/// The scene of the relaxation: solids stand, nothing happens, no heat flows, liquids have no viscosity.
Scene still_scene(Scene s) {
  s.mode = Mode::corrected;
  s.set_all_modes(Mode::corrected);
  if (!s.support_ratio_given) s.support_ratio = s.default_support_ratio();
  s.time_step.reset();
  s.transport_velocity = false;
  s.recovers = false;
  s.events.clear();
  s.inflows.clear();
  s.sources.clear();
  for (Material& m : s.materials) m.viscosity = 0.0;
  for (Body& b : s.bodies) {
    b.temperature.reset();
    b.temperature_held = false;
    if (b.phase == Phase::liquid) continue;
    if (b.motion == Motion::free)
      throw InputError(b.place, "settle = true needs solids that stand or are led, and body \"" + b.name +
                                    "\" is free: lay it into the liquid at rest, or leave settle out");
    b.motion = Motion::fixed;
    b.keyframes.clear();
  }
  return s;
}

/// Extent of the liquids along gravity [m].
double depth(const Scene& s, const InitialState& at) {
  const Vec3 down = s.gravity / norm(s.gravity);
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at.body[i] >= 0) continue;
    least = std::min(least, dot(at.position[i], down));
    most = std::max(most, dot(at.position[i], down));
  }
  return most - least + s.spacing;
}

/// Mass-weighted mean square speed of the liquids [m2/s2], summed in the order of ids.
double mean_square_speed(const State& state, const InitialState& at) {
  double sum = 0.0, mass = 0.0;
  const auto v = velocities(state.particles);
  for (std::size_t id = 0; id < at.size(); ++id) {
    if (at.body[id] >= 0) continue;
    const std::size_t row = state.particles.row(static_cast<std::uint32_t>(id));
    sum += at.mass[id] * dot(v.at(row), v.at(row));
    mass += at.mass[id];
  }
  return sum / mass;
}

/// Shifts the liquids at random: an undisturbed lattice is a saddle of the energy, which a relaxation takes
/// long to leave.
void shake(const Scene& s, InitialState& at) {
  for (std::size_t id = 0; id < at.size(); ++id) {
    if (at.body[id] >= 0) continue;
    for (std::size_t a = 0; a < 3; ++a)
      if (!(a == 1 && s.is_planar())) at.position[id][a] += shaken * s.spacing * counter_noise(s.seed, id, a);
    at.position[id] = wrapped(s, at.position[id]);
  }
}

/// Steps until the kinetic energy has passed a peak; moves the liquids of `at` there and returns the peak's
/// rms speed [m/s].
double swing(const Scene& scene, InitialState& at, long& steps) {
  Simulation simulation(scene, at);
  double peak = 0.0;
  simulation.advance_to(scene.end_time, [&] {
    const double now = mean_square_speed(simulation.state(), at);
    const bool falls = now < peak;
    peak = std::max(peak, now);
    return !falls && ++steps < most_settling_steps && !is_stopped();
  });
  if (is_stopped()) throw SettlingStopped();
  for (std::size_t id = 0; id < at.size(); ++id)
    if (at.body[id] < 0)
      at.position[id] = simulation.state().particles.position(
          simulation.state().particles.row(static_cast<std::uint32_t>(id)));
  return std::sqrt(peak);
}

}  // namespace

void stop_settling_when(bool (*wanted)() noexcept) noexcept { stop_wanted = wanted; }

InitialState settled(const Scene& scene, InitialState initial, Settling* how) {
  if (scene.gravity == Vec3{})
    throw InputError("settle = true needs something that pulls: give scene.gravity, or leave settle out");
  if (std::ranges::all_of(initial.body, [](int body) { return body >= 0; }))
    throw InputError("settle = true needs a liquid");
  Scene still = still_scene(scene);
  const double H = depth(scene, initial), pull = norm(scene.gravity);
  still.end_time = 1e4 * std::sqrt(H / pull);  // far more than most_settling_steps take
  InitialState at = initial;
  std::ranges::fill(at.velocity, Vec3{});
  at.temperature.clear();
  shake(scene, at);
  Settling s;
  s.goal = rest * std::sqrt(pull * H);
  for (int calm = 0; calm < calm_cycles && s.steps < most_settling_steps;) {
    s.speed = swing(still, at, s.steps);
    calm = s.speed < s.goal ? calm + 1 : 0;
  }
  initial.position = std::move(at.position);
  if (how) *how = s;
  return initial;
}

}  // namespace tripoint
