// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/case/preflight.hpp"

namespace tripoint {

struct Gate;
struct MetricChoice;
struct Study;

/// Warnings of what the case's gates leave open. Nothing judges the case, so that `validate` would pass it
/// unjudged; no gate looks at a metric; a known defect has a floor and no ceiling; a ladder for every engine
/// whose limit is not judged.
[[nodiscard]] std::vector<Finding> unjudged(const Case&);

/// Names of metrics that no gate and no expected class of a study looks at.
[[nodiscard]] std::vector<std::string> unjudged_metrics(const std::vector<MetricChoice>&,
                                                        const std::vector<Gate>&, const std::vector<Study>&);

}  // namespace tripoint
