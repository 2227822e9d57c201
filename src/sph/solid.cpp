// SPDX-License-Identifier: BSD-3-Clause
#include "sph/solid.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
namespace tripoint::solid {
namespace {

Eigen::Matrix3d matrix_of(const Matrix3& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz;
  return m;
}
Matrix3 plain(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}
Eigen::Vector3d vector_of(const Vec3& a) { return {a.x, a.y, a.z}; }

/// det(A) A^-1 of a symmetric matrix: for rank 2 it is a multiple of n n^T, n the direction that is missing.
Symmetric adjugate(const Symmetric& a) {
  return {a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz, a.xx * a.yy - a.xy * a.xy,
          a.xy * a.xz - a.xx * a.yz, a.xy * a.yz - a.yy * a.xz, a.xz * a.yz - a.zz * a.xy};
}

/// Unit vector of the one direction that a projector of rank 1 keeps.
Vec3 line_of(const Symmetric& P) {
  const Vec3 columns[] = {{P.xx, P.xy, P.xz}, {P.xy, P.yy, P.yz}, {P.xz, P.yz, P.zz}};
  const Vec3& longest = *std::ranges::max_element(columns, {}, [](const Vec3& c) { return norm(c); });
  return longest / norm(longest);
}

Matrix3 polar_rotation(const Matrix3& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix_of(F), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return plain(Eigen::Matrix3d(U * svd.matrixV().transpose()));
}

/// F within the plane, and the plane's normal turned with it.
Matrix3 with_normal(const Matrix3& F, const Symmetric& P) {
  const Symmetric across = symmetric_part(identity3 - full(P));
  const Vec3 n = line_of(across);
  // Two axes across n, made with the one of x and y that n is not along: where |n.x| >= 0.6, |n.y| <= 0.8.
  const Vec3 a = std::abs(n.x) < 0.6 ? cross(n, {1.0, 0.0, 0.0}) : cross(n, {0.0, 1.0, 0.0}), b = cross(n, a);
  const Vec3 turned = cross(F * a, F * b);
  return F * P + outer(turned / norm(turned), n);
}

}  // namespace

ShapeInverse shape_inverse(const Symmetric& moment) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix_of(full(moment)));
  const double largest = eigen.eigenvalues()(2);
  ShapeInverse shape;
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3 && largest > 0.0; ++k) {
    const double value = eigen.eigenvalues()(k);
    if (value < shape_cut * largest) continue;
    inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / value;
    ++shape.rank;
  }
  shape.inverse = symmetric_part(plain(inverse));
  return shape;
}

Symmetric range_projector(const Symmetric& A, int rank) {
  constexpr Symmetric all{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  if (rank == 3) return all;
  if (rank == 0) return {};
  if (rank == 1) return (1.0 / trace(A)) * A;
  const Symmetric missing = adjugate(A);
  return all - (1.0 / trace(missing)) * missing;
}

Symmetric stress(const Symmetric& strain, const Symmetric& P, int rank, const ElasticConstants& c) {
  if (rank == 1) return c.young * strain;
  const double lambda = rank == 3 ? c.lambda : 2.0 * c.lambda * c.mu / (c.lambda + 2.0 * c.mu);
  return 2.0 * c.mu * strain + (lambda * trace(strain)) * P;
}

Matrix3 rotation_of(const Matrix3& F, const Symmetric& P, int rank) {
  if (rank == 0) return identity3;
  if (rank == 3) return polar_rotation(F);
  if (rank == 2) return polar_rotation(with_normal(F, P));
  const Vec3 line = line_of(P);
  return plain(Eigen::Quaterniond::FromTwoVectors(vector_of(line), vector_of(F * line)).toRotationMatrix());
}

Quaternion quaternion_of(const Matrix3& R) {
  const Eigen::Quaterniond q(matrix_of(R));
  return normalised({q.w(), q.x(), q.y(), q.z()});
}

}  // namespace tripoint::solid
