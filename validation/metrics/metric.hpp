// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/metrics/metric_value.hpp"

namespace tripoint {

struct InitialState;
struct Job;
struct MetricChoice;
struct Trajectory;
class Reference;

/// Compares a trajectory with its reference by the metric's quantity and norm.
/// @throws InputError for an unknown quantity; a trajectory that does not fit (count, ids, times, units)
/// gives NaN and a note.
[[nodiscard]] MetricValue evaluate(const MetricChoice&, const Job&, const InitialState&, const Trajectory&,
                                   const Reference&);

/// The value that a stored series gives by the metric's norm in time, by the same rules. Nothing where the
/// value is not the norm of a series.
[[nodiscard]] std::optional<double> value_of_series(const MetricChoice&, const MetricValue&);

/// Names that `quantity` and `norm` may take, with units and meaning, for the schema.
struct MetricWord {
  std::string name, unit, meaning;
};
[[nodiscard]] const std::vector<MetricWord>& metric_quantities();
[[nodiscard]] const std::vector<MetricWord>& metric_norms();
/// Unit of a metric's value: that of the case, else the quantity's own where nothing scales it, else "1".
[[nodiscard]] std::string unit_of_value(const MetricChoice&);
/// Whether an engine may answer a quantity by a number of its own, read in its own field. Such quantities are
/// a probe, a mean, a way or a centre.
[[nodiscard]] bool can_be_gauged(const std::string& quantity);

}  // namespace tripoint
