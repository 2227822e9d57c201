// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/bench/limit.hpp"
#include "program/bench/work.hpp"
#include "step/stage_clock.hpp"

namespace tripoint::bench {

struct Spread {
  double median = 0.0, best = 0.0, worst = 0.0;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Time and size of one work. Seconds are wall seconds.
struct Measured {
  std::size_t particles = 0;
  int threads = 1;
  long steps = 0;              ///< of the timed part
  Spread step_seconds;         ///< of one step: over the rounds
  Spread cpu_seconds;          ///< of one step, all threads: not affected by other work on the machine
  StageSeconds stages{};       ///< of one step in the mean
  double outside = 0.0;        ///< of a step, in no stage
  double setup_seconds = 0.0;  ///< from the particles to the first rates
  double time_step = 0.0;      ///< the last one [s]
  double support = 0.0;        ///< [m]
  double rebuilds = 0.0;       ///< of the neighbour lists, a step
  /// Directed pairs within the support where the timed part began; 0 where they were not counted
  double pairs = 0.0;
  double bonds = 0.0;          ///< directed bonds of elastic bodies
  double bytes = 0.0;          ///< that the simulation added to the process at most
  double planned_bytes = 0.0;  ///< a particle, its fields alone
  std::string state_hash;      ///< after the last step
  std::optional<LimitSeconds> limit;
  double limit_cpu = 0.0;  ///< CPU seconds of a step of the limit
  Spread over_limit_cpu;   ///< CPU seconds of a step over those of the limit
  Spread over_limit;       ///< step over limit, by rounds: both were timed within the same seconds

  [[nodiscard]] double particle_steps_per_second() const {
    return static_cast<double>(particles) / step_seconds.median;
  }
  [[nodiscard]] double pairs_per_second() const { return pairs / step_seconds.median; }
  [[nodiscard]] double search_share() const;
};

struct MeasureOptions {
  int threads = 1;
  int rounds = 12;
  std::optional<long> steps;  ///< of the timed part; else the work's own
};

/// Times the work in rounds, each followed by a round of the limit where the work has one.
[[nodiscard]] Measured measure(const Work&, const MeasureOptions&);

}  // namespace tripoint::bench
