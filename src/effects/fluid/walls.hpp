// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "effects/fluid/material_numbers.hpp"
#include "effects/world.hpp"

namespace tripoint::fluid {

/// Walls that take what the liquid in front of them has (model 8.4) [Adami, Hu, Adams 2012]: pressure
/// p_w = sum (p_f + rho_f (g - a_w).(r_w - r_f)) W / sum W, clamped, in scenes without free bodies; velocity
/// v = 2 v_wall - sum v_f W / sum W in all. Their own number-density pressure where no liquid is near.
class Walls {
 public:
  /// Sets pressure and viscous velocity of the walls that liquid is near.
  void extrapolate(World&, const SceneNumbers&, const PairKernels&);
  /// Sets the part of the pressure forces that comes from the pressure of walls: no energy stands behind it, so its work is
  /// booked by itself. For the corrected pressure force.
  void split_forces(World&, const PairKernels&);
  /// Groups have changed: look again which particles are walls.
  void forget() { known_ = -1; }

 private:
  void find(const World&);

  std::vector<std::uint32_t> wet_walls_;  ///< rows of walls with liquid in their lists
  std::vector<std::uint32_t> border_;     ///< these, and the liquids with walls in theirs
  long known_ = -1;                       ///< the rebuild that the rows are of
};

/// Acceleration of a driven body's particle [m/s2]: towards the axis it turns about; keyframe legs have none.
[[nodiscard]] Vec3 wall_acceleration(const World&, std::size_t row);

}  // namespace tripoint::fluid
