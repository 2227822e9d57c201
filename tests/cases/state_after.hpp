// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "step/simulation.hpp"

namespace tripoint {

/// A way to make a run, which must not change a bit of it.
struct Way {
  int threads, lanes;
  bool sums_all = false;  ///< also where nothing meets
  bool changes = false;   ///< another number of threads after every step
};

struct Outcome {
  Checkpoint kept;
  std::string failure;  ///< of a scene that is meant to fail: it must do so alike
  double pairs = 0.0;
  long steps = 0;
};

/// The state after that many steps, or at the end of the scene.
inline Outcome state_after(const Scene& scene, const InitialState& initial, const Way& way, long steps) {
  Outcome outcome;
  try {
    Simulation s(
        scene, initial,
        {.threads = way.threads, .force_time_step = true, .lanes = way.lanes, .sums_all = way.sums_all});
    s.advance_to(scene.end_time, [&] {
      if (way.changes) s.use_threads(1 + static_cast<int>(s.steps() % 3));
      return --steps > 0;
    });
    outcome.kept = s.checkpoint();
    outcome.pairs = s.pairs();
    outcome.steps = s.steps();
  } catch (const Diverged& e) {
    outcome.failure = e.what();
  }
  return outcome;
}

}  // namespace tripoint
