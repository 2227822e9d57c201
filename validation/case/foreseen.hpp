// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "validation/case/preflight.hpp"

namespace tripoint {

/// Warnings of walls that leak, as they are thinner than the support, and of liquid too soft for its own
/// weight.
[[nodiscard]] std::vector<Finding> weak_containers(const Scene&, const InitialState&);

/// Notes of what a run will not show: friction on a slope, heat and melting that need longer than end_time.
[[nodiscard]] std::vector<Finding> foreseen(const Scene&);

/// CPU seconds of a run by the particle solver, within a factor of three; empty where nothing bounds its
/// step.
[[nodiscard]] std::optional<double> cpu_seconds(const Scene&, const InitialState&);

}  // namespace tripoint
