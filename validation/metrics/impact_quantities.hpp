// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/metrics/frame_error.hpp"

namespace tripoint {

[[nodiscard]] const std::vector<Quantity>& impact_quantities();
[[nodiscard]] const std::vector<RunQuantity>& impact_run_quantities();

}  // namespace tripoint
