// SPDX-License-Identifier: BSD-3-Clause
#include "sph/moments.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

namespace tripoint {
namespace {

Eigen::Matrix3d matrix_of(const Symmetric& m) {
  Eigen::Matrix3d a;
  a << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return a;
}

/// Whether no eigenvalue of a positive semidefinite matrix is below cut times the largest, by a bound without
/// a decomposition. The largest is at most g, the greatest sum of a row's magnitudes. So the smallest is at
/// least det/g^2.
bool is_regular(const Symmetric& m, double det, double cut) {
  const double g = std::max({std::abs(m.xx) + std::abs(m.xy) + std::abs(m.xz),
                             std::abs(m.xy) + std::abs(m.yy) + std::abs(m.yz),
                             std::abs(m.xz) + std::abs(m.yz) + std::abs(m.zz)});
  return m.xx > 0.0 && det > cut * g * g * g;
}

}  // namespace

double largest_eigenvalue(const Symmetric& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix_of(m), Eigen::EigenvaluesOnly)
      .eigenvalues()(2);
}

Symmetric pseudo_inverse(const Symmetric& m, double cut) {
  const Symmetric adjugate{m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
                           m.xy * m.xz - m.xx * m.yz, m.xy * m.yz - m.xz * m.yy, m.xz * m.yz - m.xy * m.zz};
  const double det = m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
  if (is_regular(m, det, cut)) return (1.0 / det) * adjugate;
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
