// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/fluid/material_numbers.hpp"
#include "effects/world.hpp"
#include "sph/pass.hpp"

namespace tripoint::fluid {

/// Walls that take what the liquid in front of them has (model 8.4) [Adami, Hu, Adams 2012]: pressure
/// p_w = sum (p_f + rho_f (g - a_w).(r_w - r_f)) W / sum W, clamped, in scenes without free bodies; velocity
/// v = 2 v_wall - sum v_f W / sum W in all. Their own number-density pressure where no liquid is near.
void extrapolate_to_walls(World&, const SceneNumbers&, const PairKernels&);

/// Acceleration of a driven body's particle [m/s2]: towards the axis it turns about; keyframe legs have none.
[[nodiscard]] Vec3 wall_acceleration(const World&, std::size_t row);

}  // namespace tripoint::fluid
