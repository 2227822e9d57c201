// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

/// Standard uncertainties, in the metric's scaled unit.
struct Uncertainty {
  double numerical = 0.0, statistical = 0.0, input = 0.0, data = 0.0;
  [[nodiscard]] double combined() const;  ///< root sum of squares
};

/// One metric of one run. A value that is not finite never passes.
struct MetricValue {
  double value = 0.0;  ///< scaled; NaN where it could not be formed
  Uncertainty uncertainty;
  std::string note;                   ///< why it could not be formed, or where the worst place is
  std::vector<double> times, series;  ///< the error in time, where the norm is over time
};

}  // namespace tripoint
