// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "files/job.hpp"
#include "files/trajectory.hpp"

namespace tripoint {

/// Position, velocity, orientation and spin of a fixed or prescribed body. Keyframes have linear position and
/// slerp, at rest before the first and after the last. Without keyframes velocity and angular velocity are
/// constant for ever. At a keyframe itself the velocity is that of the interval that begins there. Written
/// apart from the solver's own evaluation on purpose: the two check each other.
[[nodiscard]] BodyState prescribed_motion(const JobBody&, double time);

}  // namespace tripoint
