// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "program/predict/machine.hpp"
#include "program/predict/shares.hpp"

namespace tripoint::predict {

/// One measured run on one rank.
struct OneRank {
  double particles = 0.0, pairs = 0.0;  ///< directed pairs of its lists
  double seconds = 0.0;                 ///< of a step, the best of its repeats
  double bytes = 0.0;                   ///< at most in memory
};

/// Seconds of a step that a rank does alone: fixed + particle n + pair p, none of them negative.
struct WorkCost {
  double fixed = 0.0, particle = 0.0, pair = 0.0;  ///< [s]
  /// Greatest relative difference from the runs that it was fitted to
  double worst_misfit = 0.0;
  [[nodiscard]] double seconds(double particles, double pairs) const {
    return fixed + particle * particles + pair * pairs;
  }
};

/// The least relative squares over the runs; a term that would be negative is left out. @throws InputError
/// without runs, or where one has no particles, pairs or time
[[nodiscard]] WorkCost fit_work(const std::vector<OneRank>&);

/// Bytes of a rank: base + scene N + particle (own + copies), N the particles of the whole scene, which each
/// rank holds as it starts.
struct Memory {
  double base = 0.0, scene = 0.0, particle = 0.0;
  [[nodiscard]] double bytes(double whole, double held) const {
    return base + scene * whole + particle * held;
  }
};
/// From the smallest and the greatest run. @param scene_bytes a particle of the scene as it is handed over
/// and loaded
[[nodiscard]] Memory fit_memory(const std::vector<OneRank>&, double scene_bytes);

/// Requests of a step to other ranks, counted on one rank.
struct Traffic {
  double exchanges = 0.0, numbers_a_copy = 0.0, collectives = 0.0;  ///< a step
  double migrations = 0.0;                                          ///< a step
  double columns = 0.0;                                             ///< that go with a new copy
};

/// One line of the prediction: ms = work of the slowest rank + messages + bytes + collectives + waiting.
struct Prediction {
  int ranks = 1;
  double particles = 0.0;
  /// Mean of the ranks
  double own = 0.0, copies = 0.0;
  double work = 0.0, messages = 0.0, transport = 0.0, collectives = 0.0, waiting = 0.0;  ///< [s] a step
  double speed_at_once = 1.0;  ///< of a core where all have work, over one alone
  double imbalance = 1.0;      ///< work of the slowest rank over the mean
  double efficiency = 1.0;     ///< seconds of one rank, over ranks times seconds of these
  double bytes = 0.0;          ///< of the rank that holds most
  double scene_bytes = 0.0;    ///< of them, the whole scene, which is held from the start
  bool counted = false;        ///< shares were counted on the scene's own particles, not scaled by volume
  [[nodiscard]] double seconds() const { return work + messages + transport + collectives + waiting; }
  [[nodiscard]] double rate() const { return particles / seconds(); }  ///< particle-steps a second
};

/// @param whole particles and pairs of the scene on one rank
/// @param speed_at_once of a core where all have work, over its speed where no other has; of more than one
/// rank
[[nodiscard]] Prediction predict(const Shares&, const Share& whole, const WorkCost&, const Memory&,
                                 const Traffic&, const Machine&, double speed_at_once = 1.0);

}  // namespace tripoint::predict
