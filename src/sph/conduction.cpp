// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "sph/moments.hpp"

namespace tripoint {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Shares of Q's trace part below which its directions fade out (model 8.6).
constexpr double fading = 0.08;
/// |S dx|^2 of disorder within matter, which is no surface: 0.03 at a jitter of 0.2 spacings.
constexpr double disorder = 0.1;
/// f of a free surface over |S dx|^2 - disorder. The two layers at a level surface of the lattice, which have
/// |S dx| of 0.925 and 0.054, then lose an even curvature at the rate of the matter within.
constexpr double surface_share = 0.62;

constexpr double root2 = 1.4142135623730951;

/// Symmetric matrices as vectors of their length: components off the diagonal count twice.
Vector6 as_vector(const Symmetric& a) {
  Vector6 v;
  v << a.xx, a.yy, a.zz, root2 * a.yz, root2 * a.xz, root2 * a.xy;
  return v;
}
Symmetric as_matrix(const Vector6& v) { return {v(0), v(1), v(2), v(3) / root2, v(4) / root2, v(5) / root2}; }

/// Q over such vectors.
Matrix6 matrix_of(const ConductionSums& s) {
  const auto& [yyyy, yyzz, yyyz, yyxz, yyxy, zzzz, zzyz, zzxz, zzxy] = s.rest;
  const Symmetric& x = s.with_xx;
  Matrix6 q;
  q << x.xx, x.yy, x.zz, x.yz, x.xz, x.xy,  //
      x.yy, yyyy, yyzz, yyyz, yyxz, yyxy,   //
      x.zz, yyzz, zzzz, zzyz, zzxz, zzxy,   //
      x.yz, yyyz, zzyz, yyzz, zzxy, yyxz,   //
      x.xz, yyxz, zzxz, zzxy, x.zz, x.yz,   //
      x.xy, yyxy, zzxy, yyxz, x.yz, x.yy;
  q.topRightCorner<3, 3>() *= root2;
  q.bottomLeftCorner<3, 3>() *= root2;
  q.bottomRightCorner<3, 3>() *= 2.0;
  return q;
}

/// Root of a positive definite matrix by Cholesky, with one over the diagonal on it; lower triangle.
Matrix6 root_of(const Matrix6& a) {
  Matrix6 L;
  for (int k = 0; k < 6; ++k) {
    double rest = a(k, k);
    for (int n = 0; n < k; ++n) rest -= L(k, n) * L(k, n);
    L(k, k) = 1.0 / std::sqrt(rest);
    for (int i = k + 1; i < 6; ++i) {
      double sum = a(i, k);
      for (int n = 0; n < k; ++n) sum -= L(i, n) * L(k, n);
      L(i, k) = sum * L(k, k);
    }
  }
  return L;
}

/// x of L L^T x = b.
Vector6 solved_by(const Matrix6& L, Vector6 b) {
  for (int i = 0; i < 6; ++i) {
    for (int n = 0; n < i; ++n) b(i) -= L(i, n) * b(n);
    b(i) *= L(i, i);
  }
  for (int i = 5; i >= 0; --i) {
    for (int n = i + 1; n < 6; ++n) b(i) -= L(n, i) * b(n);
    b(i) *= L(i, i);
  }
  return b;
}

}  // namespace

Symmetric conduction_tensor(const ConductionSums& sums, double spacing) {
  const Matrix6 Q = matrix_of(sums);
  const Vector6 one = as_vector({1.0, 1.0, 1.0, 0.0, 0.0, 0.0}), QI = Q * one;
  const double trace = one.dot(QI);
  if (!(trace > 0.0)) return {};
  const double fade = fading * trace / 3.0, even = trace / QI.squaredNorm();
  Matrix6 squared = Q.lazyProduct(Q);
  squared.diagonal().array() += fade * fade;
  const Matrix6 root = root_of(squared);
  const auto solved = [&](const Vector6& target) { return solved_by(root, Q * target); };
  const Vector6 whole = even * one + solved(one - even * QI);
  const Vec3 lean = spacing * sums.lean;
  const double most = surface_share * (dot(lean, lean) - disorder);
  if (most <= 0.0) return as_matrix(whole);
  const Vector6 normal = as_vector(1.0 / dot(lean, lean) * square(lean)), taken = solved(normal);
  const double along = normal.dot(whole), per_f = normal.dot(taken);
  // Weights along the normal stay at least 0.
  const double f = per_f * most <= along ? most : std::max(along / per_f, 0.0);
  return as_matrix(whole - f * taken);
}

}  // namespace tripoint
