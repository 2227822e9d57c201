// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/baseline/baseline.hpp"

/// The rows of results as a baseline holds them; comparison and acceptance share them.
namespace tripoint {

/// Green gates as they stand: two that judge the same row (a limit and a band) are told apart by their order.
[[nodiscard]] std::vector<AcceptedGate> gates_of(const CaseResult&, const std::optional<CaseHashes>&);
/// All gates, red ones too, so that each keeps its place among its like.
[[nodiscard]] std::vector<AcceptedGate> all_gates_of(const CaseResult&, const std::optional<CaseHashes>&);
[[nodiscard]] bool is_accepted(const GateRow&);
/// Engine and folder of a run.
[[nodiscard]] std::string run_name(const EngineRow&, const RunRow&);
/// Whether a gate of the case has accepted anything of this engine and preset: a baseline holds nothing else.
[[nodiscard]] bool is_judged(const EngineRow&);
/// Of runs of judged engines.
[[nodiscard]] std::vector<AcceptedCost> costs_of(const CaseResult&, const Tool&);
/// Engines that a gate judges, once each.
[[nodiscard]] std::vector<AcceptedEngine> engines_of(const CaseResult&);
/// Hash of the case file's text.
[[nodiscard]] std::string hash_of_file(const CaseResult&);

/// The n-th of those that judge the same row, where n is the place of `own[index]` among its own like.
[[nodiscard]] const AcceptedGate* counterpart(const std::vector<AcceptedGate>& own, std::size_t index,
                                              const std::vector<AcceptedGate>& other);

/// Whether the engine of an accepted gate is missing on this machine, or was left out by name (--engines):
/// then the gate cannot be judged.
[[nodiscard]] bool is_absent(const CaseResult&, const AcceptedGate&, bool engines_were_chosen);

/// Accepted gates that judge nothing any more. They are of engines that have run, refused or ended before
/// their time, and of those that the case no longer names.
[[nodiscard]] std::vector<const AcceptedGate*> gone(const CaseResult&, const std::vector<AcceptedGate>& now,
                                                    const Baseline&, bool engines_were_chosen);

}  // namespace tripoint
