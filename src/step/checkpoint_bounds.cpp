// SPDX-License-Identifier: BSD-3-Clause
#include "step/checkpoint_bounds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/errors.hpp"

namespace tripoint {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("no run can go on from this checkpoint: " + what);
}

const Columns& table_of(const State& state, Per per) {
  return per == Per::body ? state.bodies : state.particles;
}

void hold(const State& state, const Bounded& bounded) {
  const Field<int>& field = bounded.field;
  const auto values = table_of(state, field.per)[field];
  const long end = static_cast<long>(bounded.end(state));
  for (std::size_t row = 0; row < values.size(); ++row) {
    const long value = values[row];
    if (value >= bounded.least && value < end) continue;
    refuse(fmt::format("{} of row {} is {}, not one of {} to {}", field.name, row, value, bounded.least,
                       end - 1));
  }
}

/// Holds amounts to what is finite and above 0.
void hold_positive(const State& state, const Field<double>& field) {
  const auto values = table_of(state, field.per)[field];
  for (std::size_t row = 0; row < values.size(); ++row)
    if (!std::isnormal(values[row]) || values[row] < 0.0)
      refuse(fmt::format("{} of row {} is {} {}", field.name, row, values[row], field.unit));
}

template <class Pair>
void hold_partners(const PairLists<Pair>& lists, const std::string& name, std::size_t particles) {
  if (lists.particles() > particles)
    refuse(fmt::format("it has {} of {} particles, and there are {}", name, lists.particles(), particles));
  for (std::size_t id = 0; id < lists.particles(); ++id)
    for (const Pair& pair : lists.of(id))
      if (pair.other >= particles)
        refuse(fmt::format("{} of particle {} lead to particle {}, and there are {}", name, id, pair.other,
                           particles));
}

/// Whether a bond stands in the list of its partner, where it says.
bool has_twin(const Bonds& bonds, std::size_t id, const Bond& bond) {
  if (bond.other >= bonds.particles()) return false;
  const auto of_other = bonds.of(bond.other);
  return bond.twin < of_other.size() && of_other[bond.twin].other == id;
}

}  // namespace

void refuse_strange_pairs(const State& state) {
  hold_partners(state.bonds, "bonds", state.particles.size());
  hold_partners(state.own, "excluded pairs", state.particles.size());
  for (std::size_t id = 0; id < state.bonds.particles(); ++id)
    for (const Bond& bond : state.bonds.of(id))
      if (!has_twin(state.bonds, id, bond))
        refuse(fmt::format("the bond of particle {} with {} is not in the list of {}", id, bond.other,
                           bond.other));
}

void refuse_strange_columns(const State& state) {
  for (const Bounded& bounded : state.bounded) hold(state, bounded);
  for (const Field<double>& field : state.positive) hold_positive(state, field);
}

}  // namespace tripoint
