// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "assembly/all_effects.hpp"

/// How long a step may be.
namespace tripoint {

/// The least bound of the effects that are on, in all processes that share the scene, which all call it.
[[nodiscard]] TimeStepBound least_bound(const State&, const std::vector<Active>&);

/// How many equal steps lead to `time` [s], none longer than `share` of the scene's own step or, where it
/// gives none, of the bound.
/// @throws Diverged where they are more than can be made
[[nodiscard]] long steps_to(const State&, double time, const TimeStepBound&, double share);

/// @param step that the scene gives, less what a recovery has taken off it [s]   @param begun whether any
/// step has been made
/// @throws InputError where it is above the bound at the start, Diverged where it has come to lie above it
void refuse_above_bound(const State&, double step, const TimeStepBound&, bool begun);

/// @throws InputError where the whole run would take more steps than can be made
void refuse_endless_run(const Scene&, const TimeStepBound& first);

}  // namespace tripoint
