// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// A round drop drawn out in the plane by u = (-A x, A y). It stays an ellipse of axes a and b, a b = R^2:
/// dA/dt = A^2 (a^2 - b^2)/(a^2 + b^2), da/dt = -A a [Monaghan 1994].
struct DropState {
  double rate = 0.0, a = 0.0, b = 0.0;  ///< A [1/s], axes along x and y [m]
};
/// Runge-Kutta of order 4 in steps of 1e-3/A0: error below 1e-10 of the axes.
[[nodiscard]] DropState elliptic_drop(double rate, double radius, double time);

}  // namespace tripoint
