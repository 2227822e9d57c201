// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>

#include "mesh/mesh.hpp"
#include "sampling/sample.hpp"

namespace tripoint {
namespace {

/// Inertia tensor about the centre [kg m2], of point masses.
Eigen::Matrix3d inertia(const std::vector<Vec3>& position, const std::vector<double>& mass,
                        const Vec3& centre) {
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec3 d = position[i] - centre;
    I(0, 0) += mass[i] * (d.y * d.y + d.z * d.z);
    I(1, 1) += mass[i] * (d.z * d.z + d.x * d.x);
    I(2, 2) += mass[i] * (d.x * d.x + d.y * d.y);
    I(0, 1) -= mass[i] * d.x * d.y;
    I(0, 2) -= mass[i] * d.x * d.z;
    I(1, 2) -= mass[i] * d.y * d.z;
  }
  I(1, 0) = I(0, 1);
  I(2, 0) = I(0, 2);
  I(2, 1) = I(1, 2);
  return I;
}

/// The same axes whatever sign the solver found: the largest component of the first two is positive, the
/// third follows.
void fix_signs(Eigen::Matrix3d& axes) {
  for (int k = 0; k < 2; ++k) {
    Eigen::Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0.0) axes.col(k) = -axes.col(k);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
}

/// Axes along x, y, z where the tensor has no products of inertia beyond round-off: no rotation is invented
/// for a cube.
Eigen::Matrix3d axes_of_diagonal(const Eigen::Vector3d& moments, Eigen::Vector3d& ascending) {
  std::array<int, 3> order{0, 1, 2};
  const double tie = 1e-12 * moments.maxCoeff();
  for (int pass = 0; pass < 2; ++pass)  // stable: equal moments keep x, y, z
    for (std::size_t i = 0; i < 2; ++i)
      if (moments(order[static_cast<std::size_t>(i + 1)]) < moments(order[i]) - tie)
        std::swap(order[i], order[static_cast<std::size_t>(i + 1)]);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    axes(order[static_cast<std::size_t>(k)], k) = 1.0;
    ascending(k) = moments(order[static_cast<std::size_t>(k)]);
  }
  return axes;
}

/// Fills in the principal moments and axes of a tensor.
void set_principal(MassProperties& p, const Eigen::Matrix3d& I) {
  const double scale = I.diagonal().maxCoeff();
  if (!(scale > 0.0)) return;  // one particle
  Eigen::Vector3d moments;
  Eigen::Matrix3d axes;
  const double products = std::max({std::abs(I(0, 1)), std::abs(I(0, 2)), std::abs(I(1, 2))});
  if (products <= 1e-12 * scale) {
    axes = axes_of_diagonal(I.diagonal(), moments);
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(I);
    moments = solver.eigenvalues();
    axes = solver.eigenvectors();
  }
  fix_signs(axes);
  for (int k = 0; k < 3; ++k)
    if (std::abs(moments(k)) <= 1e-12 * scale) moments(k) = 0.0;
  p.principal_inertia = {moments(0), moments(1), moments(2)};
  Eigen::Quaterniond q(axes);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  p.principal_axes = {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

MassProperties mass_properties(const std::vector<Vec3>& position, const std::vector<double>& mass) {
  MassProperties p;
  for (std::size_t i = 0; i < position.size(); ++i) {
    p.mass += mass[i];
    p.centre += mass[i] * position[i];
  }
  if (!(p.mass > 0.0)) return p;
  p.centre = p.centre / p.mass;
  set_principal(p, inertia(position, mass, p.centre));
  return p;
}

/// By tetrahedra between one corner of the mesh and each triangle.
MassProperties mass_properties(const Mesh& mesh, double density) {
  const Vec3 origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
  const auto arm = [&](std::uint32_t corner) {
    const Vec3 d = mesh.points[corner] - origin;
    return Eigen::Vector3d(d.x, d.y, d.z);
  };
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = arm(t[0]), b = arm(t[1]), c = arm(t[2]), sum = a + b + c;
    const double six = a.dot(b.cross(c));
    volume += six / 6.0;
    first += six / 24.0 * sum;
    second +=
        six / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  MassProperties p;
  p.mass = density * volume;
  if (!(volume > 0.0)) return p;
  const Eigen::Vector3d centre = first / volume;
  p.centre = origin + Vec3{centre.x(), centre.y(), centre.z()};
  second -= volume * centre * centre.transpose();
  set_principal(p, density * (second.trace() * Eigen::Matrix3d::Identity() - second));
  return p;
}

}  // namespace tripoint
