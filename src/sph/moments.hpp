// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/matrix3.hpp"

/// Symmetric 3 x 3 matrices that particles sum over their neighbours. Proof: tests/sph/moments_test.cpp.
namespace tripoint {

/// Pseudo-inverse of a moment, sum_k e_k e_k^T/lambda_k over its eigenvalues lambda_k of at least `cut` times
/// the largest. Smaller eigenvalues count as none (model 8.6, 8.7). The zero matrix gives zero. Where no
/// eigenvalue can be below, it is adjugate/det.
/// @param m positive semidefinite [u], whatever its unit u   @param cut in 0..1 [1]: 0.05 for heat, shape_cut
/// for solids
/// @return [1/u]
[[nodiscard]] Symmetric pseudo_inverse(const Symmetric& m, double cut);

/// Largest of the three eigenvalues, in the unit of the matrix. @param m any symmetric matrix
[[nodiscard]] double largest_eigenvalue(const Symmetric& m);

}  // namespace tripoint
