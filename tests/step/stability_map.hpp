// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

/// Where explicit steps stop being stable: measured by bisection in scenes of a few particles, beside what
/// the linear modes of the same operators predict.
namespace tripoint::stability {

/// One point of a map.
struct Point {
  std::string map;        ///< "sound", "viscosity", ...: what bounds the step
  std::string mode;       ///< corrected, paper
  std::string parameter;  ///< what is varied
  double value = 0.0;
  double predicted = 0.0;  ///< 2/omega_max or 2/lambda_max [s]
  double own = 0.0;        ///< the step that the solver chooses itself [s]
  /// Whether a small disturbance stays small at this step.
  std::function<bool(double dt)> stable;
};

/// All points, in the order of the stored map.
[[nodiscard]] std::vector<Point> all_points();

/// The largest stable step [s], to half a per cent, between 0.6 and 1.67 of the predicted one.
[[nodiscard]] double frontier(const Point&);

}  // namespace tripoint::stability
