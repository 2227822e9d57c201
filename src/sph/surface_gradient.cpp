// SPDX-License-Identifier: BSD-3-Clause
#include "sph/surface_gradient.hpp"

#include <algorithm>
#include <Eigen/Eigenvalues>
#include <numbers>

#include "sph/solid.hpp"

namespace tripoint::solid {
namespace {

using Curvature = Eigen::Matrix<double, 6, 1>;
using Moment6 = Eigen::Matrix<double, 6, 6>;

/// 1/2 x x^T as a vector of the same length, so that eigenvalues do not depend on the axes.
Curvature square_of(const Vec3& x) {
  constexpr double mixed = std::numbers::sqrt2 / 2.0;
  return {0.5 * x.x * x.x,   0.5 * x.y * x.y,   0.5 * x.z * x.z,
          mixed * x.y * x.z, mixed * x.x * x.z, mixed * x.x * x.y};
}

Eigen::Vector3d column_of(const Vec3& a) { return {a.x, a.y, a.z}; }

}  // namespace

bool at_surface(std::span<const GradientPoint> points) {
  constexpr double round_off = 1e-9;
  Vec3 inward;
  double size = 0.0;
  for (const GradientPoint& p : points) {
    inward += p.weight * p.x;
    size += p.weight * norm(p.x);
  }
  const double length = norm(inward);
  if (length <= round_off * size) return false;
  return std::ranges::none_of(
      points, [&](const GradientPoint& p) { return -dot(inward, p.x) > hides_surface * length * norm(p.x); });
}

std::vector<Vec3> curvature_correction(std::span<const GradientPoint> points, const Symmetric& A) {
  // The gradient's value for each curvature
  Eigen::Matrix<double, 6, 3> read = Eigen::Matrix<double, 6, 3>::Zero();
  for (const GradientPoint& p : points) read += square_of(p.x) * column_of(p.weight * (A * p.x)).transpose();
  const auto rest = [&](const GradientPoint& p) { return Curvature(square_of(p.x) - read * column_of(p.x)); };
  Moment6 whole = Moment6::Zero(), known = Moment6::Zero();
  for (const GradientPoint& p : points) {
    const Curvature q = square_of(p.x), r = rest(p);
    whole += p.weight * q * q.transpose();
    known += p.weight * r * r.transpose();
  }
  const double greatest =
      Eigen::SelfAdjointEigenSolver<Moment6>(whole, Eigen::EigenvaluesOnly).eigenvalues()(5);
  const Eigen::SelfAdjointEigenSolver<Moment6> eigen(known);
  Moment6 inverse = Moment6::Zero();
  for (int k = 0; k < 6; ++k)
    if (eigen.eigenvalues()(k) > shape_cut * greatest)
      inverse +=
          eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / eigen.eigenvalues()(k);
  const Eigen::Matrix<double, 3, 6> back = read.transpose() * inverse;
  std::vector<Vec3> correction;
  correction.reserve(points.size());
  for (const GradientPoint& p : points) {
    const Eigen::Vector3d c = -p.weight * (back * rest(p));
    correction.push_back({c.x(), c.y(), c.z()});
  }
  return correction;
}

}  // namespace tripoint::solid
