// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

#include "scene/scene.hpp"
#include "step/stage_clock.hpp"

namespace tripoint::bench {

/// Time of the first steps of a scene on this machine. Seconds are wall seconds, so other work on the machine
/// is in them.
struct Trial {
  std::size_t particles = 0;
  long steps = 0;              ///< that were timed
  double setup_seconds = 0.0;  ///< from the particles to the first rates
  double step_seconds = 0.0;   ///< of one step, in the mean
  StageSeconds stages{};       ///< of one step, in the mean
  double time_step = 0.0;      ///< the last one [s]
  std::string bound_by;        ///< what set it: "scene", or the bound of an effect
  double run_steps = 0.0;      ///< of the whole run at that step
  double bytes = 0.0;          ///< a particle, that the process grew by: fields, lists and scratch
  std::string failure;         ///< why there is nothing; empty = all is well

  /// Time of the whole run, at the cost of these steps [s].
  [[nodiscard]] double run_seconds() const { return setup_seconds + run_steps * step_seconds; }
};

/// Takes the first `steps` steps of a scene, or fewer where it ends before; none of one that has more than
/// `most` particles.
[[nodiscard]] Trial try_scene(const Scene&, long steps, int threads, std::size_t most);

}  // namespace tripoint::bench
