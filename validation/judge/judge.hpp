// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/results/results.hpp"

/// The one judge. It reads measured values and declared limits, never a stored verdict: the same function
/// judges a fresh run and `tripoint gate`.
namespace tripoint {

/// Fits the orders, applies every gate, and sets every verdict and exit code.
///
/// A gate applies to each engine row that it names. none = every engine but `exact`, whose error is that of
/// the reference to itself. It applies to each run of its mode and level (none = every run). Runs that differ
/// by seed only are pooled. A row that a gate names and that cannot be found is "missing" (exit 4). A value
/// that is not finite fails. A gate that judges nothing is missing, and so is a case that no gate judges.
void judge(Results&);
void judge(CaseResult&, bool engines_were_chosen);

/// Engines that were asked for on the command line and are not there, did not run, or were judged by no gate:
/// one sentence each.
[[nodiscard]] std::vector<std::string> unanswered(const Results&);

/// The orders of one engine's runs over one study. There is one for each metric and mode that is finite at
/// every level (the interval need not be).
[[nodiscard]] std::vector<OrderRow> fit_orders(const CaseResult&, const EngineRow&, const Study&);

/// Standard uncertainty that the resolution of a run leaves, by the grid convergence index of the case's
/// studies in space and in time, added up. Against a truth the error itself is measured, and this is 0. It
/// counts where the reference is an experiment, the run's own limit or another engine.
[[nodiscard]] double numerical_uncertainty(const CaseResult&, const EngineRow&, const RunRow&,
                                           const std::string& metric);

/// Half the difference of a metric between both ends of each uncertain input, root sum of squares. 0 where
/// the case names none, NaN where an end gave no value.
[[nodiscard]] double input_uncertainty(const EngineRow&, const RunRow&, const std::string& metric);

}  // namespace tripoint
