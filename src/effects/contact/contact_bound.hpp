// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"
#include "state/step_numbers.hpp"

namespace tripoint::contact {

/// Until a solid that can move is pressed; 0 where one is [s].
inline constexpr StepNumber time_to_touch{"time_to_touch", 0.0, true};

/// Bound of contact where solids are stiffer, or where steps shorten at a touch (model 8.10). @param length
/// share of the support radius that sound may cross in a step [m]   @param speed greatest of a particle [m/s]
[[nodiscard]] TimeStepBound contact_bound(const State&, const liquid::SceneNumbers&, double length,
                                          double speed);

/// How long it takes until a solid that can move is pressed, as its densities grow now: 0 where one is
/// pressed, or where nothing is known yet of how they grow (model 8.10). Sets `time_to_touch` [s]. To be
/// called once for all new places, after (4).
void update_time_to_touch(State&, const liquid::SceneNumbers&);

/// Velocities or bodies have changed at once, so that nothing is known of how densities grow: the next time
/// to a touch is 0.
void forget_time_to_touch(State&);

}  // namespace tripoint::contact
