// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/results/results.hpp"

/// Cost of accuracy, from runs that were made: error and CPU seconds along one knob of one engine, and the
/// cheapest settings for a wish.
namespace tripoint {

struct Scene;

struct LadderPoint {
  double level = 0.0;  ///< in the axis's own unit
  double step = 0.0;   ///< finer = smaller
  double error = 0.0;  ///< |value| + 2 u, which is compared with a limit
  double cpu_s = 0.0;
  double pairs = 0.0;
};

/// Runs of one engine, preset and mode that differ along one axis only, coarse to fine.
struct Ladder {
  std::string engine, preset;
  JudgedMode mode = JudgedMode::none;
  Axis axis = Axis::spacing;
  std::vector<LadderPoint> points;
};

/// One for each engine row, mode and axis with at least two levels whose metric is finite and not zero.
[[nodiscard]] std::vector<Ladder> ladders_of(const CaseResult&, const std::string& metric);

/// A number with the factor by which it may be off either way.
struct Prediction {
  double value = 0.0, factor = 1.0;
};

/// Along straight lines in log-log between neighbouring levels; outside them along the outermost line. The
/// factor is what the slope's own change between neighbouring intervals would make of it, and 1.1 at least
/// (seconds are never better known).
[[nodiscard]] Prediction predicted_error(const Ladder&, double step);
[[nodiscard]] Prediction predicted_cpu(const Ladder&, double step);

/// Recommended settings: a level of a ladder, and the expected result.
struct Recommendation {
  const Ladder* ladder = nullptr;
  double level = 0.0;
  Prediction error, cpu_s;
};

/// Levels that a scene takes. A spacing divides all lengths that the measured ones divide, a time step
/// divides the output interval, walkers and iterations are whole. Within twice beyond the measured ones at
/// the fine end, and not beyond the coarsest.
[[nodiscard]] std::vector<double> possible_levels(const Scene&, const Ladder&);

/// The cheapest level of any ladder whose predicted error is at most this; empty when none is.
[[nodiscard]] std::optional<Recommendation> cheapest_for_error(const Scene&, const std::vector<Ladder>&,
                                                               double error);
/// The level of any ladder with the least predicted error whose predicted CPU seconds are at most these.
[[nodiscard]] std::optional<Recommendation> best_within(const Scene&, const std::vector<Ladder>&,
                                                        double cpu_s);

}  // namespace tripoint
