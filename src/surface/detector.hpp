// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/matrix3.hpp"

namespace tripoint {

/// Eigenvalues of grad rbar between which the surface is drawn closer to its particles; the paper's values,
/// of its plot of (25).
struct DetectorLimits {
  double t_low = 0.4, t_high = 2.0;  ///< [1], t_low < t_high
};

/// f of (25), (26): 1 below t_low, 0 beyond t_high (where (25) alone would fall below zero), g^3 - 3 g^2 + 3
/// g between. Its first and second derivatives are continuous at t_low, as the paper says.
/// @param largest_eigenvalue of grad rbar [1]
[[nodiscard]] double detector_factor(double largest_eigenvalue, const DetectorLimits& = {}) noexcept;

/// EV_max of (25): the largest real part of the three eigenvalues. grad rbar is not symmetric, so two of them
/// may be complex; the paper does not say what "largest" means then. By the closed form of the cubic: an
/// iterative solver costs ten times the sums it is made from. Compared with Eigen's solver:
/// tests/surface/detector_test.cpp.
[[nodiscard]] double largest_eigenvalue(const Matrix3&) noexcept;

}  // namespace tripoint
