// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/harness/results.hpp"

/// The one judge. It reads measured values and declared limits, never a stored verdict: the same function judges a fresh run and
/// `tripoint gate`.
namespace tripoint {

/// Fits the orders, applies every gate, and sets every verdict and exit code.
///
/// A gate applies to each engine row that it names. none = every engine but `exact`, whose error is that of the reference to
/// itself. It applies to each run of its mode and level (none = every run). Runs that differ by seed only are pooled. A row that
/// a gate names and that cannot be found is "missing" (exit 4). A value that is not finite fails. A gate that judges nothing is
/// missing, and so is a case that no gate judges.
void judge(Results&);
void judge(CaseResult&, bool engines_were_chosen);

/// Whether a row ran and no gate looked at it: it says nothing of the engine, good or bad. `exact` is the reference itself and is
/// never judged.
[[nodiscard]] bool is_unjudged(const EngineRow&);

/// Engines that were asked for on the command line and are not there, did not run, or were judged by no gate: one sentence each.
[[nodiscard]] std::vector<std::string> unanswered(const Results&);

/// The orders of one engine's runs over one study. There is one for each metric and mode that is finite at every level (the
/// interval need not be).
[[nodiscard]] std::vector<OrderRow> fit_orders(const CaseResult&, const EngineRow&, const Study&);

/// Value of NAME, or of NAME.statistical (its statistical standard uncertainty), in one run; empty when the run has no such
/// metric.
[[nodiscard]] std::optional<MetricValue> measured(const RunRow&, const std::string& metric);

/// Standard uncertainty that the resolution of a run leaves, by the grid convergence index of the case's studies in space and in
/// time, added up. Against a truth the error itself is measured, and this is 0. It counts where the reference is an experiment,
/// the run's own limit or another engine.
[[nodiscard]] double numerical_uncertainty(const CaseResult&, const EngineRow&, const RunRow&, const std::string& metric);

/// Half the difference of a metric between both ends of each uncertain input, root sum of squares. 0 where the case names none,
/// NaN where an end gave no value.
[[nodiscard]] double input_uncertainty(const EngineRow&, const RunRow&, const std::string& metric);

/// Mean of runs that differ by seed only: the statistical uncertainty is the larger of the stated one and the scatter, over
/// sqrt(n).
[[nodiscard]] MetricValue pooled(const std::vector<MetricValue>&);

/// Whether a run ended otherwise than it should: killed, timeout, error, or a status that nobody knows. An engine that is missing
/// or refuses says so; this one does not.
[[nodiscard]] bool crashed(const RunRow&);

/// Whether the case declares that this form of the model diverges.
[[nodiscard]] bool may_diverge(const CaseResult&, JudgedMode mode);

/// Whether a study of the case says that this engine runs at levels.
[[nodiscard]] bool applies(const Study&, const std::string& engine, JudgedMode mode);

/// Two levels are the same to 1e-9 of their size.
[[nodiscard]] bool same_level(double a, double b);

}  // namespace tripoint
