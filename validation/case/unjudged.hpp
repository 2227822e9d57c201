// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/case/preflight.hpp"

namespace tripoint {

/// One warning where nothing judges the case: no gate, no class of convergence that a study expects, no divergence that it
/// declares. It can be run, and `validate` passes nothing unjudged.
[[nodiscard]] std::vector<Finding> unjudged(const Case&);

}  // namespace tripoint
