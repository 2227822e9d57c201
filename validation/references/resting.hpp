// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "validation/references/functions.hpp"

namespace tripoint {

/// One free box or ball above one fixed body, along gravity.
struct BoxOnFloor {
  std::size_t block = 0, axis = 0;  ///< row in Job::bodies of the box; 0, 1, 2 for x, y, z
  double up = 1.0;                  ///< +1 or -1: away from gravity along the axis
  double rest = 0.0;                ///< place of the box's centre along the axis where faces touch [m]
  std::vector<BodyState> start;     ///< of all bodies, one row each
};
/// @throws InputError unless the scene is one free box or ball above one fixed body under gravity along an
/// axis
[[nodiscard]] BoxOnFloor box_on_floor(const ReferenceInput&, const char* function);

}  // namespace tripoint
