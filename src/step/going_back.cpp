// SPDX-License-Identifier: BSD-3-Clause
// Scenes that recover: actions of a run when a guard trips.
#include <utility>

#include "step/simulation.hpp"

namespace tripoint {

void Simulation::keep_good_state() {
  if (world_.scene.recovers) recovery_.keep(state(), world_.time);
}

/// Everything as it was at a good state, but for the share of the step.
void Simulation::go_back(const Diverged& failure) {
  const Checkpoint& good = recovery_.go_back(failure);
  const Scene scene = std::move(world_.scene);
  world_ = World{};
  set_up(scene, start_);
  restore(good);
  schedule_.drop_plan();
}

}  // namespace tripoint
