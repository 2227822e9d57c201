// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/metrics/members.hpp"

/// Motion of a bar or beam in one frame. The reference names the bar (row in the job's bodies), its axis, and
/// which end is free.
namespace tripoint {

struct Measured {
  double value = 0.0;
  std::string problem;  ///< why there is no value
  bool of_tip = false;  ///< of a rigid body at the end, not of the bar's own last layer
};

/// Displacement along the reference's direction [m]: of the named rigid body's centre, else a mean. The mean
/// is over the bar's particles that began within one spacing of its free end.
[[nodiscard]] Measured deflection(const MetricInput&, const Snapshot&);

/// Distance of two layers, one spacing thick, over their distance at the start [1].
/// @param gauge middle share of the bar's length that they bound; 1 = its ends
[[nodiscard]] Measured stretch(const MetricInput&, const Snapshot&, double gauge);

/// Force on the metric's body along the bar, positive where the bar pulls it towards itself [N].
[[nodiscard]] Measured reaction(const MetricInput&, const Snapshot&);

/// offset + amplitude cos(frequency t + phase) by least squares.
struct Swing {
  double offset = 0.0, amplitude = 0.0, frequency = 0.0;  ///< [m], [m], [rad/s]
  std::string problem;
};
/// @param guess frequency, the fit looks from 0.4 to 2.5 of it [rad/s]
[[nodiscard]] Swing fit_swing(const std::vector<double>& time, const std::vector<double>& value,
                              double guess);

}  // namespace tripoint
