// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/matrix3.hpp"
#include "core/quaternion.hpp"
#include "sph/moments.hpp"

/// Elastic solids, (10)-(17): formulas of one particle, printed and corrected (model 2, 8.7). F_ab =
/// dx_a/dX_b.
namespace tripoint::solid {

/// Eigenvalues of M_i below this share of the largest count as none: below it, refrozen clusters are
/// unstable.
inline constexpr double shape_cut = 0.2;

/// A_i = pinv M_i (model 8.7), and how many directions it spans: 3 solid, 2 sheet, 1 chain, 0 without
/// neighbours.
struct ShapeInverse {
  Symmetric inverse;  ///< A_i [1]
  int rank = 0;
};
/// @param moment M_i = sum_j v_j gradW(x_ij)(x_j - x_i)^T [1], positive semidefinite
[[nodiscard]] ShapeInverse shape_inverse(const Symmetric& moment);

/// P, the projector on the range of A_i [1] (model 8.7). @param shape_inverse A_i [1]   @param rank of it,
/// 0..3
[[nodiscard]] Symmetric range_projector(const Symmetric& shape_inverse, int rank);

/// F of a particle [1], (14): I + sum_j v_j u_ji gradW(x_ij)^T A_i. The paper has no A_i: give the identity.
/// @param displacement_sum sum_j v_j u_ji gradW(x_ij)^T [1]   @param shape_inverse A_i [1]
[[nodiscard]] constexpr Matrix3 deformation_gradient(const Matrix3& displacement_sum,
                                                     const Symmetric& shape_inverse) noexcept {
  return identity3 + displacement_sum * shape_inverse;
}

/// Green's strain 1/2 (F^T F - I) [1] (model 8.7).
[[nodiscard]] constexpr Symmetric green_strain(const Matrix3& F) noexcept {
  return symmetric_part(0.5 * (transposed(F) * F - identity3));
}
/// Strain of MKN04, which the paper follows: F^T F - I [1]. Its fault: without the 1/2 the material is 4
/// times as stiff.
[[nodiscard]] constexpr Symmetric strain_paper(const Matrix3& F) noexcept { return 2.0 * green_strain(F); }

/// Young's modulus E and Lame's constants of an isotropic solid.
struct ElasticConstants {
  double young = 0.0, lambda = 0.0, mu = 0.0;  ///< [Pa]
};
/// lambda = E nu/((1 + nu)(1 - 2 nu)), mu = E/(2 (1 + nu)).
/// @param young E [Pa]   @param poisson nu [1], above -1 and below 0.5, where lambda is infinite
[[nodiscard]] constexpr ElasticConstants elastic_constants(double young, double poisson) noexcept {
  return {young, young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
          young / (2.0 * (1.0 + poisson))};
}
[[nodiscard]] constexpr ElasticConstants operator*(double factor, const ElasticConstants& c) noexcept {
  return {factor * c.young, factor * c.lambda, factor * c.mu};
}

/// S = 2 mu eps + lambda tr(eps) P [Pa]; in sheets lambda -> 2 lambda mu/(lambda + 2 mu), no stress across;
/// in chains S = E eps.
/// @param strain eps [1], within the range of P   @param rank of P, 0..3
[[nodiscard]] Symmetric stress(const Symmetric& strain, const Symmetric& P, int rank,
                               const ElasticConstants&);

/// The rotation of F P: polar; of the plane for a sheet, the least rotation of the line for a chain, none at
/// rank 0.
[[nodiscard]] Matrix3 rotation_of(const Matrix3& F, const Symmetric& P, int rank);
/// The same rotation as a unit quaternion. @param R orthogonal, det R = 1
[[nodiscard]] Quaternion quaternion_of(const Matrix3& R);

/// Hourglass residual of a bond, full rank: F x_ji - r_ji [m], 0 where F tells all that the pair does
/// [Ganzenmueller 2015].
[[nodiscard]] constexpr Vec3 hourglass_residual(const Matrix3& F, const Vec3& x_ji,
                                                const Vec3& r_ji) noexcept {
  return F * x_ji - r_ji;
}
/// The same of a sheet or a chain [1], where that form sees rotations: (|r_ji|^2 - x_ji^T (I + 2 eps)
/// x_ji)/(2 |x_ji|^2).
/// @param strain eps of green_strain() [1]   @param x_ji, r_ji reference and present vector of the pair [m]
[[nodiscard]] constexpr double hourglass_residual_flat(const Symmetric& strain, const Vec3& x_ji,
                                                       const Vec3& r_ji) noexcept {
  return (dot(r_ji, r_ji) - dot(x_ji, x_ji) - 2.0 * dot(x_ji, strain * x_ji)) / (2.0 * dot(x_ji, x_ji));
}

}  // namespace tripoint::solid
