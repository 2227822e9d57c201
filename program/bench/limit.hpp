// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "program/bench/lane_loops.hpp"
#include "scene/scene.hpp"

namespace tripoint::bench {

/// Seconds of the parts of one step.
struct LimitSeconds {
  int lanes = 0;
  /// Again: heat's second stage, corrected forms only
  double search = 0.0, density = 0.0, rates = 0.0, again = 0.0;
  /// One step, with the search shared by as many steps as a list lasts. @param rebuilds a step
  [[nodiscard]] double step(double rebuilds) const { return density + rates + again + rebuilds * search; }
};

/// The hand-written loops at given places, timed part by part in rounds. So they can be interleaved with the
/// loops that they are compared with: this machine's speed drifts while it runs.
class Limit {
 public:
  /// @param mode whose terms: those of (4), (7), (8), (21) or of their corrected forms
  /// @param support, skin as the lists of the solver [m]
  Limit(std::span<const Vec3> positions, Mode mode, double support, double skin, int threads);
  /// Runs the loops of every vector unit some times, and their search once.
  void round();
  /// Least seconds of the parts, of the vector unit with the least step. @param rebuilds of lists a step
  [[nodiscard]] LimitSeconds best(double rebuilds) const;
  /// Seconds of a step of that unit in each round, in order. The mean of some steps of a solver is to be
  /// compared with them.
  /// @param rebuilds of lists a step, of the whole   @param of_rounds of each round: a round of few steps has
  /// more or less
  [[nodiscard]] std::vector<double> steps(double rebuilds, std::span<const double> of_rounds) const;
  /// The same in CPU seconds of all threads, which other work on the machine does not lengthen.
  [[nodiscard]] std::vector<double> steps_cpu(double rebuilds, std::span<const double> of_rounds) const;
  /// Sums of the density loop of a vector unit, row by row as the search sorts them; for tests.
  [[nodiscard]] std::vector<double> density(std::size_t unit);
  /// The same of the rate loop, one sum after the other.
  [[nodiscard]] std::vector<double> sums(std::size_t unit);
  [[nodiscard]] std::size_t units() const noexcept { return runners_.size(); }
  [[nodiscard]] double pairs() const noexcept { return pairs_; }  ///< directed pairs within the support

 private:
  struct Runner {
    LaneLoops loops;
    LaneLists lists;
    LimitSeconds least;
    std::vector<LimitSeconds> rounds, rounds_cpu;
  };
  [[nodiscard]] const Runner& fastest(double rebuilds) const;
  void sort();
  void search(Runner&);

  Mode mode_;
  double support_, reach_;
  int threads_;
  LaneColumns start_, columns_;
  LaneCells cells_;
  std::vector<Runner> runners_;
  double pairs_ = 0.0;
  bool first_ = true;
};

}  // namespace tripoint::bench
