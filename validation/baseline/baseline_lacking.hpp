// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/baseline/baseline.hpp"

/// Accepted rows that the results lack: nothing of a baseline goes without a word.
namespace tripoint {

/// Appends to `after` the rows of engines that did not run, where `lacking` keeps them. @return the gates and
/// the runs that go, a line each
/// @throws InputError that names the engines and metrics that are neither kept nor dropped
[[nodiscard]] std::string carry_over(const CaseResult&, const Baseline& before, Baseline& after,
                                     const Lacking& lacking, bool engines_were_chosen);

}  // namespace tripoint
