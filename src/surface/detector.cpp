// SPDX-License-Identifier: BSD-3-Clause
#include "surface/detector.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {

double detector_factor(double largest_eigenvalue, const DetectorLimits& limits) noexcept {
  if (largest_eigenvalue < limits.t_low) return 1.0;
  if (largest_eigenvalue > limits.t_high) return 0.0;
  const double g = (limits.t_high - largest_eigenvalue) / (limits.t_high - limits.t_low);
  return g * (g * (g - 3.0) + 3.0);
}

double largest_eigenvalue(const Matrix3& a) noexcept {
  // x^3 - trace x^2 + minors x - det = 0; with x = third + t: t^3 + p t + q = 0.
  const double third = (a.xx + a.yy + a.zz) / 3.0;
  const Matrix3 b = a - third * identity3;
  const double p = (b.xx * b.yy - b.xy * b.yx) + (b.xx * b.zz - b.xz * b.zx) + (b.yy * b.zz - b.yz * b.zy);
  const double q = -determinant(b);
  const double half = 0.5 * q, slope = p / 3.0;
  const double discriminant = half * half + slope * slope * slope;
  if (discriminant <= 0.0) {  // three real roots
    const double size = std::sqrt(-slope);
    if (size == 0.0) return third;
    const double angle = std::acos(std::clamp(-half / (size * size * size), -1.0, 1.0));
    return third + 2.0 * size * std::cos(angle / 3.0);
  }
  const double root = std::sqrt(discriminant);
  // Of the two the one that is not a difference
  const double u = std::cbrt(half > 0.0 ? -half - root : -half + root);
  // The real root; the pair's real part is -t/2
  const double t = u - slope / u;
  return third + std::max(t, -0.5 * t);
}

}  // namespace tripoint
