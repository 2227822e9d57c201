// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat_equal.hpp"

#include <algorithm>

#include "effects/heat/enthalpy.hpp"
#include "scene/phase_values.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::heat {
namespace {

double heat_at(const State& state, std::size_t row, double temperature) {
  const auto phase = static_cast<Phase>(state.particles[field::phase][row]);
  return enthalpy_of(state.particles[field::mass][row], heat_capacity_of(state.material_of(row), phase),
                     temperature);
}

}  // namespace

void EqualHeat::load(State&, const InitialState& initial) {
  if (std::ranges::any_of(initial.temperature, [&](double T) { return T != temperature_; }))
    throw InputError("the scene has one temperature everywhere, and its particles have others");
}

/// Particles that have flowed in bring their heat.
void EqualHeat::adopt(State& state) {
  for (const std::uint32_t id : state.change.born)
    state.accumulated[account::inflow] += heat_at(state, state.particles.row(id), temperature_);
}

void EqualHeat::lose(State& state, std::span<const std::size_t> rows) {
  for (const std::size_t i : rows) state.accumulated[account::outflow] += heat_at(state, i, temperature_);
}

void EqualHeat::add_to(const State& state, Ledger& ledger) const {
  std::vector<std::array<double, 1>> blocks;
  const auto sums = ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    sum[0] += heat_at(state, i, temperature_);
  });
  ledger.energy["thermal"] += sums[0];
}

}  // namespace tripoint::heat
