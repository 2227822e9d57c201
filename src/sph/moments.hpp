// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "core/matrix3.hpp"
#include "core/vec3.hpp"

/// Symmetric 3 x 3 matrices that particles sum over their neighbours. Proof: tests/sph/moments_test.cpp.
namespace tripoint {

/// Pseudo-inverse of a moment, sum_k e_k e_k^T/lambda_k over its eigenvalues lambda_k of at least `cut` times
/// the largest. Smaller eigenvalues count as none (model 8.6, 8.7). The zero matrix gives zero. Where no
/// eigenvalue can be below, it is adjugate/det.
/// @param m positive semidefinite [u], whatever its unit u   @param cut in 0..1 [1]: 0.05 for heat, shape_cut
/// for solids
/// @return [1/u]
[[nodiscard]] Symmetric pseudo_inverse(const Symmetric& m, double cut);

/// What a particle sums over its neighbours for conduction (model 8.6); d = r_j - r_i, e = d/|d|, and
/// w = 1/2 V_j K.
struct ConductionSums {
  Symmetric with_xx;             ///< sum w d_x d_x e e^T: one row of Q = sum w d d^T e e^T [1]
  std::array<double, 9> rest{};  ///< the rest of Q: yyyy yyzz yyyz yyxz yyxy zzzz zzyz zzxz zzxy [1]
  Vec3 lean;                     ///< S = sum 2 w d, towards the side where neighbours are [1/m]
};

/// B of model 8.6 [1]: weights e^T B e w conduct along and across as matter does, Q : B = I - f s s^T. The
/// last term is of a free surface, s its normal, where temperature has no slope. Directions that neighbours
/// do not span count as none. @param spacing [m]
[[nodiscard]] Symmetric conduction_tensor(const ConductionSums&, double spacing);

/// Largest of the three eigenvalues, in the unit of the matrix. @param m any symmetric matrix
[[nodiscard]] double largest_eigenvalue(const Symmetric& m);

}  // namespace tripoint
