// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/harness/results.hpp"

/// The parts of the judge that look at one gate.
namespace tripoint {

enum class Applied {
  judged,         ///< rows were made
  absent,         ///< the engine, or the run that the gate wants, is not there, and the engine's own row says so
  not_applicable  ///< the engine has no such mode or level by the case's own words
};

/// Applies a gate to one engine row, which it names; its rows are appended to the engine's.
Applied apply_gate(const CaseResult&, const Gate&, EngineRow&);

/// The class of convergence that a study declares, as one row for each mode.
Applied apply_expected_class(const CaseResult&, const Study&, EngineRow&);

/// Verdict on a value with its standard uncertainty against everything that the gate sets; on an order against its interval.
[[nodiscard]] Verdict verdict_of(const Gate&, double value, double uncertainty);
[[nodiscard]] Verdict verdict_of(const Gate&, const Order&);

/// Whether a gate looks at runs of a form of the model. "not paper" is every engine's, other engines' too, but not our printed
/// form.
[[nodiscard]] bool fits_mode(const Gate&, JudgedMode mode);

/// "limit 1e-3", "at least 1.8", "band 0.9 to 1.1".
[[nodiscard]] std::string describe(const Gate&);

}  // namespace tripoint
