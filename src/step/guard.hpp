// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/world.hpp"

namespace tripoint {

/// Looks for values that are not finite, in the order in which a step writes fields, so that the first that went wrong is named.
/// @throws Diverged with particle, body, field, stage and time
void check_finite(const World&);

}  // namespace tripoint
