// SPDX-License-Identifier: BSD-3-Clause
#include "sph/moments.hpp"

#include <Eigen/Eigenvalues>

namespace tripoint {
namespace {

Eigen::Matrix3d matrix_of(const Symmetric& m) {
  Eigen::Matrix3d a;
  a << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return a;
}

}  // namespace

double largest_eigenvalue(const Symmetric& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix_of(m), Eigen::EigenvaluesOnly).eigenvalues()(2);
}

Symmetric pseudo_inverse(const Symmetric& m, double cut) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix_of(m));
  const double largest = eigen.eigenvalues()(2);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3 && largest > 0.0; ++k) {
    const double value = eigen.eigenvalues()(k);
    if (value < cut * largest) continue;
    inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / value;
  }
  return {inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(1, 2), inverse(0, 2), inverse(0, 1)};
}

}  // namespace tripoint
