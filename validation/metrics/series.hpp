// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/metrics/frame_error.hpp"

namespace tripoint {

/// Errors of all chosen frames under one norm in space.
struct Series {
  std::vector<double> times, value, uncertainty;
  std::vector<long> worst;
};

/// Their norm in time, for each norm but frequency, swing and L2mean.
[[nodiscard]] MetricValue over_time(Norm, const Series&);

/// The dominant frequency less the one that the case states: of a damped or uneven swing as of a sine.
[[nodiscard]] MetricValue frequency_of(const MetricInput&, const Series&);

/// Half of greatest minus least, less the amplitude that the case states.
[[nodiscard]] MetricValue swing_of(const MetricInput&, const Series&);

/// At each of the kept times [s] the mean over the times that lie within half of `length` [s] of it.
/// @return why it cannot be formed; "" where it is
[[nodiscard]] std::string average_over(Series&, double length, const std::vector<double>& kept,
                                       double tolerance);

}  // namespace tripoint
