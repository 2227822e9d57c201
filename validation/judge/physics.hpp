// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/results/results.hpp"

/// The second verdict. A gate says whether a value is as expected; this says whether what was measured is
/// right. A declared defect that holds is as expected, and its value is wrong all the same.
namespace tripoint {

/// Sets share and physics of every row of a judged case, of its engines and of the case.
///
/// A row is a known defect where its gate declares one (of an engine, or of the printed form) and holds. It
/// is wrong where its gate fails, right where it holds, not known where no value decides. An engine is the
/// worst of its rows, a case of its engines.
void settle_physics(CaseResult&);

/// "right", "wrong", "known defect soft-contact".
[[nodiscard]] std::string physics_text(Physics, const std::vector<std::string>& defects);
[[nodiscard]] std::string physics_text(const GateRow&);
/// Of a case: "right", or by whom it is not: "known defect soft-contact (rapier, mujoco), wrong (stone)".
[[nodiscard]] std::string physics_text(const CaseResult&);

/// Of cases: "physics: 12 right, 2 with known defects, 1 wrong"; what counts none is left out, but for the
/// wrong ones.
[[nodiscard]] std::string physics_counts(const Results&);

}  // namespace tripoint
