// SPDX-License-Identifier: BSD-3-Clause
#include "step/resting.hpp"

#include <algorithm>

#include "state/body_table.hpp"

namespace tripoint {

Resting fixed_bodies(const State& state, double beyond) {
  Resting rest{std::vector<char>(state.bodies.size()), beyond};
  for (std::size_t b = 0; b < rest.bodies.size(); ++b) {
    if (!is_alive(state, b) || !is_rigid(state, b)) continue;
    rest.bodies[b] = state.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed);
    // As it moves for the first time, all are put to their places
    if (!rest.bodies[b] && !state.placed) return {};
  }
  if (std::ranges::find(rest.bodies, 1) == rest.bodies.end()) return {};
  return rest;
}

}  // namespace tripoint
