// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

/// Checks of the values in a checkpoint. The seal shows accidental changes only: a file of another program,
/// or of a broken memory, can have a valid seal. So row numbers are held to the rows that there are, and
/// amounts to the range that formulas bear, before anything is computed from them. No check can tell whether
/// a run can reach the state.
namespace tripoint {

/// @throws InputError naming the list, where a partner is no particle, or a bond is not in the list of its
/// partner
void refuse_strange_pairs(const State&);
/// @throws InputError naming the column and the row
void refuse_strange_columns(const State&);

}  // namespace tripoint
