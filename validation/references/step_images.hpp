// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/references/heat_scene.hpp"

namespace tripoint {

/// A step of height one: 1 from the bar's low end to `place`, 0 above.
struct StepImages {
  BarAxis bar;
  double place = 0.0;        ///< [m]
  double diffusivity = 0.0;  ///< [m2/s]
};

/// The step after a time by images, at x or as the mean over [x - cell/2, x + cell/2] (cell > 0):
///   1/2 sum_n [erf((x - a_n)/s) - erf((x - b_n)/s)], s = sqrt(4 D t), [a_n, b_n] the images of the low side.
/// Insulated ends mirror it (period 2 L), a periodic bar repeats it (period L). Its integral over the bar is
/// constant.
[[nodiscard]] double share_of_low_side(const StepImages&, double x, double cell, double time);

}  // namespace tripoint
