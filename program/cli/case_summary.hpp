// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

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

}  // namespace tripoint
