// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "core/matrix3.hpp"

/// Gradients at the surface of a solid that are exact for curved displacements too (model 8.7). One-sided
/// neighbourhoods read a curvature as a gradient, which makes bars bend too far.
namespace tripoint::solid {

/// A partner of a particle as its gradient sees it.
struct GradientPoint {
  Vec3 x;               ///< x_ji = x_j - x_i [m]
  double weight = 0.0;  ///< -v_j W'(|x|)/|x|, positive: d_ij = weight A x_ji [1/m2]
};

/// Cosine of the greatest angle from the outward normal at which a partner hides a surface. A face of the
/// lattice has none below 90 degrees and, with a jitter of 0.2, below 68; inside there is one within 45.
inline constexpr double hides_surface = 0.65;

/// Whether no partner lies outward of a particle, outward being against the mean of its partners. False where
/// they have no side.
[[nodiscard]] bool at_surface(std::span<const GradientPoint>);

/// Terms added to each d_ij so that sum_j d_ij u_ji^T is the gradient at x_i also of displacements of second
/// order. Curvatures are left out of which less than shape_cut is known, as along the normal. The measure is
/// |x|^2-weighted moments, without their linear part. sum_j c_j x_ji^T = 0, so a linear displacement is seen
/// as before: test surface_gradient_test.cpp. Moving least squares, complete to second order, in the
/// directions that are known [Belytschko et al. 1996].
/// @param A inverse of the moment of these points, of rank 3 [1]   @return c_j [1/m], by point
[[nodiscard]] std::vector<Vec3> curvature_correction(std::span<const GradientPoint>, const Symmetric& A);

}  // namespace tripoint::solid
