// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat_paper.hpp"

#include <algorithm>

#include "core/machine.hpp"
#include "effects/heat/enthalpy.hpp"
#include "effects/heat/fields.hpp"
#include "effects/heat/heat_terms.hpp"
#include "effects/heat/thermal_particles.hpp"
#include "scene/effect_rule.hpp"
#include "scene/scene_keys.hpp"
#include "solids/fusion.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::heat {
namespace {

/// m (c_p T + L f) [J]
double printed_heat(const State& state, std::size_t row) {
  const Particles& p = state.particles;
  const double sensible =
      enthalpy_of(p[field::mass][row], p[field::heat_capacity][row], p[field::temperature][row]);
  return p.has(field::liquid_fraction.name) ? sensible + latent_heat(state, row) : sensible;
}

double set_printed_temperature(State& state, std::size_t row, double temperature) {
  Particles& p = state.particles;
  const double given =
      p[field::mass][row] * p[field::heat_capacity][row] * (temperature - p[field::temperature][row]);
  p[field::temperature][row] = temperature;
  const double bound = p.has(field::liquid_fraction.name) ? latent_heat(state, row) : 0.0;
  set_melted(state, row, temperature);
  return p.has(field::liquid_fraction.name) ? given + latent_heat(state, row) - bound : given;
}

}  // namespace

void PaperHeat::load(State& state, const InitialState& initial) {
  load_common(state, initial);
  for (std::size_t i = 0; i < state.particles.size(); ++i) set_material(state, i);
}

void PaperHeat::set_material(State& state, std::size_t row) const {
  const Material& m = state.material_of(row);
  const double own = *m.conductivity / (m.density * *m.heat_capacity);
  const double one = kept_number(state.scene.values, key_row("scene", "heat_constant"));  // 0 = none is given
  // The paper's c [m2/s]
  state.particles[field::diffusivity][row] = one > 0.0 ? one : own;
}

/// Particles that have flowed in bring their heat.
void PaperHeat::adopt(State& state) {
  const Particles& p = state.particles;
  for (const std::uint32_t id : state.change.born) {
    const std::size_t i = p.row(id);
    load_particle(state, i, inflow_temperature(state, i));
    set_material(state, i);
    state.accumulated[account::inflow] += printed_heat(state, i);
  }
}

void PaperHeat::lose(State& state, std::span<const std::size_t> rows) {
  for (const std::size_t i : rows) state.accumulated[account::outflow] += printed_heat(state, i);
}

void PaperHeat::drift(State& state, double dt) {
  Particles& p = state.particles;
  const auto T = p[field::temperature], rate = p[field::temperature_rate], m = p[field::mass],
             c_p = p[field::heat_capacity];
  const auto held = p[field::held], material = p[field::material];
  const bool melts = p.has(field::liquid_fraction.name);
  const auto f = melts ? p[field::liquid_fraction] : std::span<double>{};
  const std::vector<Fusion> fusions = melts ? fusions_of(state.scene) : std::vector<Fusion>{};
  std::vector<std::array<double, 1>> blocks;
  const auto to_walls = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (held[i]) {
      sum[0] += enthalpy_of(m[i], c_p[i], rate[i] * dt);
      return;
    }
    T[i] += dt * rate[i];
    if (!melts) return;
    const ThermalState thermal = settled(fusions[static_cast<std::size_t>(material[i])], T[i], f[i]);
    T[i] = thermal.temperature;
    f[i] = thermal.liquid_fraction;
  });
  state.accumulated[account::walls] += to_walls[0];
  accumulate_held(state, [&](std::size_t i) { return enthalpy_of(m[i], c_p[i], rate[i] * dt); });
}

void PaperHeat::happen(State& state, const Happening& now) {
  hold_temperature(state, now, set_printed_temperature);
}

/// 1/max_i sum_j of the coefficients of T_j - T_i (model 8.10).
TimeStepBound PaperHeat::max_dt(const State& state) const {
  const Particles& p = state.particles;
  const auto exchange = p[field::exchange];
  const auto held = p[field::held];
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) \
    reduction(max                                                    \
              : greatest) if (p.size() > worth_threads)
  for (std::size_t i = 0; i < exchange.size(); ++i) {
    if (!held[i]) greatest = std::max(greatest, exchange[i]);
  }
  TimeStepBound bound;
  if (greatest > 0.0) tighten(bound, 1.0 / greatest, "heat");
  return bound;
}

void PaperHeat::add_to(const State& state, Ledger& ledger) const {
  const Particles& p = state.particles;
  const bool melts = p.has(field::liquid_fraction.name);
  const auto m = p[field::mass], c_p = p[field::heat_capacity], T = p[field::temperature];
  std::vector<std::array<double, 2>> blocks;
  const auto sums = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, 2>& sum) {
    sum[0] += enthalpy_of(m[i], c_p[i], T[i]);
    if (melts) sum[1] += latent_heat(state, i);
  });
  ledger.energy["thermal"] += sums[0];
  if (melts) ledger.energy["latent"] += sums[1];
}

PairWork PaperHeat::pair_work(const Scene&) const { return {{pair_term<HeatFlowPaper>}}; }

}  // namespace tripoint::heat
