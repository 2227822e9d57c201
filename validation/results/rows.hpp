// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "validation/results/results.hpp"

/// Questions about the rows of results that need no verdict.
namespace tripoint {

/// Whether a row ran and no gate looked at it: it says nothing of the engine, good or bad. `exact` is the
/// reference itself and is never judged.
[[nodiscard]] bool is_unjudged(const EngineRow&);

/// Value of NAME, or of NAME.statistical (its statistical standard uncertainty), in one run; empty when the
/// run has no such metric.
[[nodiscard]] std::optional<MetricValue> measured(const RunRow&, const std::string& metric);

/// Mean of runs that differ by seed only: the statistical uncertainty is the larger of the stated one and the
/// scatter, over sqrt(n).
[[nodiscard]] MetricValue pooled(const std::vector<MetricValue>&);

/// Whether a run ended otherwise than it should: killed, timeout, error, or a status that nobody knows. An
/// engine that is missing or refuses says so; this one does not.
[[nodiscard]] bool crashed(const RunRow&);

/// Whether the case declares that this form of the model diverges.
[[nodiscard]] bool may_diverge(const CaseResult&, JudgedMode mode);

/// Whether a study of the case says that this engine runs at levels.
[[nodiscard]] bool applies(const Study&, const std::string& engine, JudgedMode mode);

/// Two levels are the same to 1e-9 of their size.
[[nodiscard]] bool same_level(double a, double b);

}  // namespace tripoint
