// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/case/preflight.hpp"

namespace tripoint::bench {
struct Trial;
}

namespace tripoint {

struct Case;
struct Plan;
struct Scene;

/// A case on ten lines: its claim, the simulated scene, the truth, the judged metrics, the engines, and the
/// cost.
[[nodiscard]] std::string case_summary(const Case&, const Scene&, const Plan&, const bench::Trial&);

/// One note where liquid that lies still above fixed solids will move when it is let go. It starts as a
/// lattice, which is no equilibrium. It moves at 0.03 to 0.06 sqrt(g H) rms for seconds (docs/still-water.md)
/// unless its viscosity holds that back. There is no note where the scene says `settle`, or holds a free
/// solid, with which it cannot settle.
/// @param state of the scene's particles at the start
[[nodiscard]] std::vector<Finding> start_notes(const Scene&, const InitialState& state);

}  // namespace tripoint
