// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat_corrected.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/machine.hpp"
#include "effects/heat/enthalpy.hpp"
#include "effects/heat/fields.hpp"
#include "effects/heat/heat_terms.hpp"
#include "effects/heat/thermal_particles.hpp"
#include "solids/fusion.hpp"
#include "sph/moments.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::heat {
namespace {

constexpr double small_step = 0.005;  ///< of dx^2 over the greatest diffusivity (decision 040)
constexpr double steps_held = 3.0;    ///< that take the same B_i (decision 048)

/// H = m (c_p T + L f) [J] at the particle's temperature, and the extra heat of the liquid above t_melt.
double heat_content(const State& state, std::size_t row) {
  const Particles& p = state.particles;
  const double sensible =
      enthalpy_of(p[field::mass][row], p[field::heat_capacity][row], p[field::temperature][row]);
  if (!p.has(field::liquid_fraction.name)) return sensible;
  const Fusion fusion = fusion_of(state.scene, state.material_of(row));
  if (fusion.jump == 0.0) return sensible + latent_heat(state, row);
  return sensible + p[field::mass][row] * p[field::heat_capacity][row] *
                        bound_heat(fusion, p[field::temperature][row], p[field::liquid_fraction][row]);
}

/// Conductivity of both phases of a material [W/m/K].
struct Conductivity {
  double solid = 0.0, liquid = 0.0;
  /// Conductivity of a particle of the given phase. While it changes it conducts as the phase that it turns
  /// into. The front runs through it, and the heat that moves the front comes through the phase that grows.
  [[nodiscard]] double of(int phase, double f) const {
    const bool is_liquid = f >= 1.0 || (f > 0.0 && phase != static_cast<int>(Phase::liquid));
    return is_liquid ? liquid : solid;
  }
};
Conductivity conductivity_of(const Material& m) {
  if (!m.conductivity) return {};
  return {m.solid_conductivity.value_or(*m.conductivity), *m.conductivity};
}

/// Greatest conductivity over least heat capacity of a volume, of all materials together [m2/s].
double greatest_diffusivity(const Scene& scene) {
  double k = 0.0, least = std::numeric_limits<double>::infinity();
  for (const Material& m : scene.materials) {
    if (!m.conductivity || !m.heat_capacity) continue;
    const Conductivity of = conductivity_of(m);
    k = std::max({k, of.solid, of.liquid});
    least = std::min(least, m.density * std::min(*m.heat_capacity, solid_capacity(m)));
  }
  return k / least;
}

/// A particle conducts as its phase does, or as the phase that it turns into.
void follow_phase(State& state, std::size_t row) {
  const Material& m = state.material_of(row);
  state.particles[field::conductivity][row] =
      m.solid_conductivity
          ? conductivity_of(m).of(state.particles[field::phase][row], liquid_share(state, row))
          : conductivity_of(m).liquid;
}

double set_temperature(State& state, std::size_t row, double temperature) {
  Particles& p = state.particles;
  const double before = p[field::enthalpy][row];
  set_melted(state, row, temperature);
  p[field::temperature][row] = temperature;
  p[field::enthalpy][row] = heat_content(state, row);
  follow_phase(state, row);
  return p[field::enthalpy][row] - before;
}

/// H_i += change(i), T from H, and with the last stage f. The heat that a held particle would have taken goes
/// to the walls. The first stage gives T only: f follows the heat of the whole step, whatever the way
/// between.
template <class Change>
void add_heat(State& state, Stage stage, Change change) {
  Particles& p = state.particles;
  const auto H = p[field::enthalpy], T = p[field::temperature], m = p[field::mass],
             c_p = p[field::heat_capacity];
  const auto held = p[field::held], material = p[field::material];
  const bool melts = p.has(field::liquid_fraction.name);
  const auto f = melts ? p[field::liquid_fraction] : std::span<double>{};
  const std::vector<Fusion> fusions = melts ? fusions_of(state.scene) : std::vector<Fusion>{};
  std::vector<Conductivity> conducts;  // empty where no phase change touches it
  if (melts && stage == Stage::last && std::ranges::any_of(state.scene.materials, [](const Material& one) {
        return one.solid_conductivity.has_value();
      }))
    for (const Material& one : state.scene.materials) conducts.push_back(conductivity_of(one));
  const auto k = p[field::conductivity];
  const auto phase = p[field::phase];
  std::vector<std::array<double, 1>> blocks;
  const auto to_walls = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (held[i]) {
      sum[0] += change(i);
      return;
    }
    H[i] += change(i);
    T[i] = temperature_of(m[i], c_p[i], H[i]);
    if (!melts) return;
    const Fusion& fusion = fusions[static_cast<std::size_t>(material[i])];
    const ThermalState thermal = settled(fusion, temperature_at(fusion, T[i], f[i]), f[i]);
    T[i] = thermal.temperature;
    if (stage == Stage::last) f[i] = thermal.liquid_fraction;
    if (!conducts.empty()) k[i] = conducts[static_cast<std::size_t>(material[i])].of(phase[i], f[i]);
  });
  state.accumulated[account::walls] += to_walls[0];
  accumulate_held(state, change);
}

/// Least heat capacity of either phase over that of the solid, by material: a particle may change its phase
/// within the step. Empty where the phases do not differ.
std::vector<double> least_capacities(const State& state) {
  std::vector<double> shares;
  if (!state.particles.has(field::liquid_fraction.name) ||
      std::ranges::none_of(state.scene.materials,
                           [](const Material& m) { return m.solid_heat_capacity.has_value(); }))
    return shares;
  for (const Fusion& fusion : fusions_of(state.scene)) shares.push_back(std::min(1.0, 1.0 + fusion.jump));
  return shares;
}

}  // namespace

namespace {

bool is_small(const State& state, double dt) {
  return dt * greatest_diffusivity(state.scene) <= small_step * state.scene.spacing * state.scene.spacing;
}

}  // namespace

void CorrectedHeat::load(State& state, const InitialState& initial) {
  load_common(state, initial);
  surfaces_.load(state, initial);
  for (std::size_t i = 0; i < state.particles.size(); ++i) set_material(state, i);
}

void CorrectedHeat::set_material(State& state, std::size_t row) const {
  Particles& p = state.particles;
  follow_phase(state, row);
  p[field::rest_volume][row] = p[field::mass][row] / state.material_of(row).density;
  p[field::enthalpy][row] = heat_content(state, row);
}

/// Particles that have flowed in bring their heat.
void CorrectedHeat::adopt(State& state) {
  for (const std::uint32_t id : state.change.born) {
    const std::size_t i = state.particles.row(id);
    load_particle(state, i, inflow_temperature(state, i));
    set_material(state, i);
    state.accumulated[account::inflow] += state.particles[field::enthalpy][i];
  }
}

void CorrectedHeat::lose(State& state, std::span<const std::size_t> rows) {
  for (const std::size_t i : rows) state.accumulated[account::outflow] += state.particles[field::enthalpy][i];
}

/// First stage: an Euler step with the rates of the old time, which are kept for the second.
void CorrectedHeat::drift(State& state, double dt) {
  state.step_numbers[b_held_for] += 1.0;
  const auto rate = state.particles[field::heat_rate];
  std::ranges::copy(rate, state.particles[field::heat_rate_before].begin());
  surfaces_.accumulate(state, Stage::first, dt);
  add_heat(state, Stage::first, [&](std::size_t i) { return dt * rate[i]; });
}

/// Second stage: H = 1/2 H_old + 1/2 (H_1 + dt dH/dt(H_1)), written as a change of H_1. Where the step is
/// small beside the bound (8.10), dH/dt(H_1) serves as the rate of the new time too (decision 040).
bool CorrectedHeat::correct(State& state, double dt) {
  surfaces_.accumulate(state, Stage::last, dt);
  const auto rate = state.particles[field::heat_rate], before = state.particles[field::heat_rate_before];
  add_heat(state, Stage::last, [&](std::size_t i) { return 0.5 * dt * (rate[i] - before[i]); });
  return !is_small(state, dt);
}

/// A few steps take the same B_i; where matter has changed they are formed anew.
void CorrectedHeat::decide_sums(State& state) {
  double& held = state.step_numbers[b_held_for];
  state.holds_sums = state.can_hold_sums && held > 0.0 && held < steps_held && state.change.empty();
  if (!state.holds_sums) held = 0.0;
}

void CorrectedHeat::start_sums(State& state, PassName pass, const Rows&) {
  if (pass != PassName::density || !state.holds_sums) surfaces_.start_sums(state, pass);
}

/// B_i of every particle, of the sums of the density pass.
void CorrectedHeat::state(State& state, const Rows& rows) {
  if (!state.moved || state.holds_sums) return;
  Particles& p = state.particles;
  const auto B = symmetric_columns(p, field::moment_inverse), spread = symmetric_columns(p, field::spread);
  const auto rest = matrix_columns(p, field::spread_rest).a;
  const auto lean = triple(p, field::lean);
  const double dx = state.scene.spacing;
  for_rows(rows, state.threads, [&](std::size_t i) {
    ConductionSums sums{spread.at(i), {}, lean.at(i)};
    for (std::size_t k = 0; k < rest.size(); ++k) sums.rest[k] = rest[k][i];
    B.set(i, conduction_tensor(sums, dx));
  });
}

void CorrectedHeat::happen(State& state, const Happening& now) {
  hold_temperature(state, now, set_temperature);
}

/// 1/max_i sum_j G_ij/C_i (model 8.10): the one bound that gives a discrete maximum principle.
TimeStepBound CorrectedHeat::max_dt(const State& state) const {
  const Particles& p = state.particles;
  const auto G = p[field::conductance], m = p[field::mass], c_p = p[field::heat_capacity];
  const auto held = p[field::held], material = p[field::material];
  const std::vector<double> least = least_capacities(state);
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) \
    reduction(max                                                    \
              : greatest) if (p.size() > worth_threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!held[i])
      greatest = std::max(
          greatest,
          G[i] / (m[i] * c_p[i] * (least.empty() ? 1.0 : least[static_cast<std::size_t>(material[i])])));
  }
  TimeStepBound bound;
  if (greatest > 0.0) tighten(bound, 1.0 / greatest, "heat");
  return bound;
}

void CorrectedHeat::add_to(const State& state, Ledger& ledger) const {
  const auto H = state.particles[field::enthalpy];
  const bool melts = state.particles.has(field::liquid_fraction);
  std::vector<std::array<double, 2>> blocks;
  const auto sums = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, 2>& sum) {
    const double bound = melts ? latent_heat(state, i) : 0.0;
    sum[0] += H[i] - bound;
    sum[1] += bound;
  });
  ledger.energy["thermal"] += sums[0];
  if (melts) ledger.energy["latent"] += sums[1];
}

PairWork CorrectedHeat::pair_work(const Scene&) const {
  PairWork work{{pair_term<HeatMoment>, pair_term<HeatFlowCorrected>}};
  work.again = true;
  work.held = {pair_term<HeatMoment>};
  return work;
}

}  // namespace tripoint::heat
