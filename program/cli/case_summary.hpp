// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "assembly/plan.hpp"
#include "program/bench/trial.hpp"
#include "validation/case/case.hpp"

namespace tripoint {

/// A case on ten lines: its claim, the simulated scene, the truth, the judged metrics, the engines, and the cost.
[[nodiscard]] std::string case_summary(const Case&, const Scene&, const Plan&, const bench::Trial&);

}  // namespace tripoint
