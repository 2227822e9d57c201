// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat_paper.hpp"

#include <algorithm>

#include "effects/heat/enthalpy.hpp"
#include "effects/heat/thermal_particles.hpp"

namespace tripoint::heat {
namespace {

double set_temperature(Particles& p, std::size_t row, double temperature) {
  const double given = p[field::mass][row] * p[field::heat_capacity][row] * (temperature - p[field::temperature][row]);
  p[field::temperature][row] = temperature;
  return given;
}

}  // namespace

void PaperHeat::load(World& world, const InitialState& initial) {
  load_common(world, initial);
  const auto c = world.particles[field::diffusivity];
  const double density = 1.0 + defect_size("heat.paper.density");
  const double faster = 1.0 + defect_size("heat.paper.diffusivity");
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Material& m = world.material_of(i);
    c[i] = faster * *m.conductivity / (m.density * density * *m.heat_capacity);  // the paper's c [m2/s]
  }
}

void PaperHeat::drift(World& world, double dt) {
  Particles& p = world.particles;
  const auto T = p[field::temperature], rate = p[field::temperature_rate], m = p[field::mass], c_p = p[field::heat_capacity];
  const auto held = p[field::held];
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (held[i]) {
      world.booked.walls += enthalpy_of(m[i], c_p[i], rate[i] * dt);
    } else {
      T[i] += dt * rate[i];
    }
  }
}

void PaperHeat::clear(World& world, PassName pass) {
  if (pass != PassName::rates) return;
  std::ranges::fill(world.particles[field::temperature_rate], 0.0);
  std::ranges::fill(world.particles[field::exchange], 0.0);
}

void PaperHeat::happen(World& world, const Happening& now) { hold_temperature(world, now, set_temperature); }

/// 1/max_i sum_j of the coefficients of T_j - T_i (model 8.10).
TimeStepBound PaperHeat::max_dt(const World& world) const {
  const auto exchange = world.particles[field::exchange];
  const auto held = world.particles[field::held];
  double greatest = 0.0;
  for (std::size_t i = 0; i < exchange.size(); ++i) {
    if (!held[i]) greatest = std::max(greatest, exchange[i]);
  }
  TimeStepBound bound;
  if (greatest > 0.0) tighten(bound, 1.0 / greatest, "heat");
  return bound;
}

void PaperHeat::add_to(const World& world, Ledger& ledger) const {
  const Particles& p = world.particles;
  double sum = 0.0;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    sum += enthalpy_of(p[field::mass][i], p[field::heat_capacity][i], p[field::temperature][i]);
  }
  ledger.energy["thermal"] += sum;
}

}  // namespace tripoint::heat
