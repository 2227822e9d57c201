// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/results/results.hpp"

/// The parts of the judge that look at one gate.
namespace tripoint {

enum class Applied {
  judged,  ///< rows were made
  /// The engine, or the run that the gate wants, is not there, and the engine's own row says so
  absent,
  not_applicable  ///< the engine has no such mode or level by the case's own words
};

/// Applies a gate to one engine row, which it names; its rows are appended to the engine's.
Applied apply_gate(const CaseResult&, const Gate&, EngineRow&);

/// The class of convergence that a study declares, as one row for each mode.
Applied apply_expected_class(const CaseResult&, const Study&, EngineRow&);

/// Verdict on a value with its standard uncertainty against everything that the gate sets; on an order
/// against its interval. An order is that of an error that falls to the truth: where the errors end on a
/// floor it fails, whatever the number, unless the gate declares that class.
[[nodiscard]] Verdict verdict_of(const Gate&, double value, double uncertainty);
[[nodiscard]] Verdict verdict_of(const Gate&, const Order&);

/// Part of a gate's allowance that a value uses: 0 is best, 1 is at the edge, more is outside. It is the one
/// rule of the program:
///   limit         |value| over it;
///   band with 0   the same, with the edge on the value's side;
///   other band    distance from its middle over half its width: the band states a figure;
///   at_least      it over the value; below it 2 - value/at_least.
/// Of several edges the largest counts. An edge at 0 leaves no allowance: beyond it the part is 1 and the
/// metric's own unit. NaN for a value that is no number, and for a gate without an edge.
[[nodiscard]] double share_of_limit(const Gate&, double value);

/// Whether a gate looks at runs of a form of the model. "not paper" is every engine's, other engines' too,
/// but not our printed form.
[[nodiscard]] bool fits_mode(const Gate&, JudgedMode mode);

/// "limit 1e-3", "at least 1.8", "band 0.9 to 1.1".
[[nodiscard]] std::string describe(const Gate&);

}  // namespace tripoint
