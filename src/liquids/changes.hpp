// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "state/free_rows.hpp"
#include "state/state.hpp"

namespace tripoint::liquid {

/// Whether a change of phase or of bodies moves particles from one group to another (field::group).
[[nodiscard]] inline bool groups_changed(const State& state) {
  return !state.change.regrouped.empty() || !state.change.bodies.empty();
}

/// Of what can move [m/s].
[[nodiscard]] inline double greatest_speed(const State& state) {
  const auto v = velocities(state.particles);
  const FreeLoops loops = free_loops(state.forces.size());
  return std::sqrt(
      greatest_of_blocks(state.particles.moving(), state.threads, [&](std::size_t from, std::size_t to) {
        return loops.greatest_speed2({v.x.data(), v.y.data(), v.z.data()}, from, to);
      }));
}

}  // namespace tripoint::liquid
