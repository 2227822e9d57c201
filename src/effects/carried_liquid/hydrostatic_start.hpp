// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "state/state.hpp"

namespace tripoint::carried_liquid {

/// Pressure at time 0 of each row [Pa]: the weight above it in its column, where that column stands on a wall
/// without a gap; else 0.
[[nodiscard]] std::vector<double> hydrostatic_start(const State&);

}  // namespace tripoint::carried_liquid
