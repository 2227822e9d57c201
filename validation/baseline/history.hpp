// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/baseline/baseline.hpp"

/// Past measurements: JSON lines that are only ever appended. The reference is the truth, the baseline the
/// last accepted state, the history the record of all.
namespace tripoint {

/// One line a case: commit, date, machine, seed, verdict and every count. It also has every gated value with
/// its uncertainty and the share of its limit that it uses.
[[nodiscard]] std::string history_lines(const Results&);

/// One line for each accepted case (no ids: all): a mark in the strip.
[[nodiscard]] std::string acceptance_lines(const Results&, const std::vector<std::string>& ids,
                                           const Acceptance&);

/// Appends whole lines at once, so that two writers do not mix theirs. @throws EngineError when the file
/// cannot be written
void append_history(const std::string& file, const std::string& lines);

/// The history that a results.json names, as a path; empty = it names none.
[[nodiscard]] std::string history_file(const Results&, const std::string& results_file);

}  // namespace tripoint
