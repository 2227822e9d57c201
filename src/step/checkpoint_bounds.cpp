// SPDX-License-Identifier: BSD-3-Clause
#include "step/checkpoint_bounds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/errors.hpp"

namespace tripoint {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw InputError("no run can go on from this checkpoint: " + what); }

/// Holds whole numbers of a column to [least, end).
void hold(const Columns& columns, const Field<int>& field, long least, std::size_t end) {
  if (!columns.has(field.name)) return;
  const auto values = columns[field];
  for (std::size_t row = 0; row < values.size(); ++row) {
    const long value = values[row];
    if (value >= least && value < static_cast<long>(end)) continue;
    refuse(fmt::format("{} of row {} is {}, not one of {} to {}", field.name, row, value, least, static_cast<long>(end) - 1));
  }
}

/// Holds amounts that formulas divide by, and densities, to what is finite and above 0.
void hold_positive(const Columns& columns, const Field<double>& field) {
  if (!columns.has(field.name)) return;
  const auto values = columns[field];
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
        refuse(fmt::format("{} of particle {} lead to particle {}, and there are {}", name, id, pair.other, particles));
}

/// Whether a bond stands in the list of its partner, where it says.
bool has_twin(const Bonds& bonds, std::size_t id, const Bond& bond) {
  if (bond.other >= bonds.particles()) return false;
  const auto of_other = bonds.of(bond.other);
  return bond.twin < of_other.size() && of_other[bond.twin].other == id;
}

}  // namespace

void refuse_strange_pairs(const World& world) {
  hold_partners(world.bonds, "bonds", world.particles.size());
  hold_partners(world.own, "own pairs", world.particles.size());
  for (std::size_t id = 0; id < world.bonds.particles(); ++id)
    for (const Bond& bond : world.bonds.of(id))
      if (!has_twin(world.bonds, id, bond))
        refuse(fmt::format("the bond of particle {} with {} is not in the list of {}", id, bond.other, bond.other));
}

void refuse_strange_columns(const World& world) {
  constexpr std::size_t phases = 3, motions = 3, ranks = 4, yes_or_no = 2;
  const Scene& scene = world.scene;
  const std::size_t bodies = world.bodies.size(), materials = scene.materials.size(), events = scene.events.size();
  const std::size_t sources = scene.bodies.size() + scene.inflows.size();
  hold(world.particles, field::body, -1, bodies);
  hold(world.particles, field::phase, 0, phases);
  hold(world.particles, field::material, 0, materials);
  hold(world.particles, field::solid_material, 0, materials);
  hold(world.particles, field::source, 0, sources);
  hold(world.particles, field::driven, driven_in, static_cast<std::size_t>(driven_grip) + events);
  hold(world.particles, field::shape_rank, 0, ranks);
  hold(world.bodies, field::body_phase, 0, phases);
  hold(world.bodies, field::body_motion, 0, motions);
  hold(world.bodies, field::body_alive, 0, yes_or_no);
  hold(world.bodies, field::body_grip, 0, events + 1);
  hold(world.bodies, field::body_source, -1, scene.bodies.size());
  for (const auto& field : {field::mass, field::density, field::heat_capacity}) hold_positive(world.particles, field);
}

}  // namespace tripoint
