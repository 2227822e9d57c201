// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "world/world.hpp"

/// What a checkpoint may say. Its seal shows what was altered by accident; a file of another program, or of a broken memory, can
/// have a seal that holds. So numbers that stand for rows are held to the rows that there are, and amounts to those that formulas
/// bear, before anything is worked out of them. Whether a state is one that a run can come to, nobody can tell.
namespace tripoint {

/// @throws InputError naming the list, where a partner is no particle, or a bond is not in the list of its partner
void refuse_strange_pairs(const World&);
/// @throws InputError naming the column and the row
void refuse_strange_columns(const World&);

}  // namespace tripoint
