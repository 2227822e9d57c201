// SPDX-License-Identifier: BSD-3-Clause
// Scenes that recover: actions of a run when a guard trips.
#include <utility>

#include "step/simulation.hpp"

namespace tripoint {

void Simulation::keep_good_state() {
  if (state_.scene.recovers) recovery_.keep(whole_checkpoint(), state_.time);
}

/// Everything as it was at a good state, but for the share of the step. Processes that share the scene all go
/// back at once; some may name other particles than the rest do.
void Simulation::go_back(const Diverged& failure) {
  const Checkpoint& good = recovery_.go_back(state_.halo ? sharing_.first_failure(failure).value() : failure);
  const Scene scene = std::move(state_.scene);
  state_ = State{};
  sharing_.begin_anew();
  set_up(scene, start_);
  restore(good);
  schedule_.drop_plan();
}

}  // namespace tripoint
