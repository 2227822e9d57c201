// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "world/free_rows.hpp"
#include "world/world.hpp"

namespace tripoint::liquid {

/// Whether a change of phase or of bodies moves particles from one group to another (field::group).
[[nodiscard]] inline bool groups_changed(const World& world) {
  return !world.change.regrouped.empty() || !world.change.bodies.empty();
}

/// Of what can move [m/s].
[[nodiscard]] inline double greatest_speed(const World& world) {
  const auto v = velocities(world.particles);
  const FreeLoops loops = free_loops(world.forces.size());
  return std::sqrt(
      greatest_of_blocks(world.particles.moving(), world.threads, [&](std::size_t from, std::size_t to) {
        return loops.greatest_speed2({v.x.data(), v.y.data(), v.z.data()}, from, to);
      }));
}

}  // namespace tripoint::liquid
