// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "validation/case/case.hpp"
#include "validation/references/reference.hpp"

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

/// Compares a trajectory with its reference by the metric's quantity and norm.
/// @throws InputError for an unknown quantity; a trajectory that does not fit (count, ids, times, units) gives NaN and a
/// note.
[[nodiscard]] MetricValue evaluate(const MetricChoice&, const Job&, const InitialState&, const Trajectory&, const Reference&);

/// The value that a stored series gives by the metric's norm in time, by the same rules. Nothing where the value is not the norm
/// of a series.
[[nodiscard]] std::optional<double> value_of_series(const MetricChoice&, const MetricValue&);

/// Names that `quantity` and `norm` may take, with units and meaning, for the schema.
struct MetricWord {
  std::string name, unit, meaning;
};
[[nodiscard]] const std::vector<MetricWord>& metric_quantities();
[[nodiscard]] const std::vector<MetricWord>& metric_norms();
/// Unit of a metric's value: that of the case, else the quantity's own where nothing scales it, else "1".
[[nodiscard]] std::string unit_of_value(const MetricChoice&);
/// Whether an engine may answer a quantity by a number of its own, read in its own field. Such quantities are a probe, a mean, a
/// way or a centre.
[[nodiscard]] bool can_be_gauged(const std::string& quantity);

}  // namespace tripoint
