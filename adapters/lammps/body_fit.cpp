// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/body_fit.hpp"

#include <Eigen/Dense>

namespace tripoint::lammps {
namespace {

/// Unit quaternion that takes the columns a to b in the least-squares sense. [Horn 1987, 4.A]
/// @param S sum of m a b^T
Quaternion horn(const Eigen::Matrix3d& S) {
  Eigen::Matrix4d N;
  N << S(0, 0) + S(1, 1) + S(2, 2), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0),
      S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2), S(2, 0) - S(0, 2),
      S(0, 1) + S(1, 0), -S(0, 0) + S(1, 1) - S(2, 2), S(1, 2) + S(2, 1), S(0, 1) - S(1, 0),
      S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), -S(0, 0) - S(1, 1) + S(2, 2);
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(N).eigenvectors().col(3);
  const double sign = q(0) < 0.0 ? -1.0 : 1.0;
  return normalised({sign * q(0), sign * q(1), sign * q(2), sign * q(3)});
}

/// Shortest rotation from the direction a to b.
Quaternion swing(const Vec3& a, const Vec3& b) {
  const Vec3 axis = cross(a, b);
  const double w = norm(a) * norm(b) + dot(a, b);
  if (w > 1e-12 * norm(a) * norm(b)) return normalised({w, axis.x, axis.y, axis.z});
  const Vec3 side = std::abs(a.x) < std::abs(a.y) ? cross(a, Vec3{1, 0, 0}) : cross(a, Vec3{0, 1, 0});
  return normalised({0.0, side.x, side.y, side.z});
}

Vec3 spin_of(const MassProperties& start, const Quaternion& orientation, const Vec3& L) {
  const Quaternion principal = orientation * start.principal_axes;
  Vec3 w = rotate_back(principal, L);
  for (std::size_t k = 0; k < 3; ++k)
    w[k] = start.principal_inertia[k] > 0.0 ? w[k] / start.principal_inertia[k] : 0.0;
  return rotate(principal, w);
}

}  // namespace

BodyState fit_body(const MassProperties& start, const std::vector<std::size_t>& members,
                   const InitialState& before, const Snapshot& now) {
  BodyState s;
  s.mass = start.mass;
  for (const std::size_t i : members) {
    s.position += (now.mass[i] / start.mass) * now.position[i];
    s.velocity += (now.mass[i] / start.mass) * now.velocity[i];
  }
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  Vec3 L, far_before, far_now;
  for (const std::size_t i : members) {
    const Vec3 a = before.position[i] - start.centre, b = now.position[i] - s.position;
    S += now.mass[i] * Eigen::Vector3d(a.x, a.y, a.z) * Eigen::RowVector3d(b.x, b.y, b.z);
    L += now.mass[i] * cross(b, now.velocity[i] - s.velocity);
    if (dot(a, a) > dot(far_before, far_before)) {
      far_before = a;
      far_now = b;
    }
  }
  if (start.principal_inertia.x > 0.0)
    s.orientation = horn(S);
  else if (start.principal_inertia.z > 0.0)
    s.orientation = swing(far_before, far_now);
  s.angular_velocity = spin_of(start, s.orientation, L);
  return s;
}

}  // namespace tripoint::lammps
