// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/rigid_body.hpp"

#include <Eigen/Dense>

namespace tripoint {
namespace {

Vec3 from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

void set_principal_axes(RigidBody& body, const std::vector<double>& mass) {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < body.members.size(); ++n) {
    const Eigen::Vector3d r = to_eigen(body.offset[n]);
    inertia += mass[body.members[n]] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  const Eigen::Quaterniond q(axes);
  body.axes = normalised({q.w(), q.x(), q.y(), q.z()});
  // A moment at round-off of the largest is none: a line of particles has no spin about itself.
  Eigen::Vector3d moments = solver.eigenvalues();
  for (int k = 0; k < 3; ++k) moments[k] = moments[k] > 1e-12 * moments[2] ? moments[k] : 0.0;
  body.inertia = from_eigen(moments);
}

}  // namespace

RigidBody rigid_body(const std::vector<std::size_t>& members, const std::vector<Vec3>& position,
                     const std::vector<Vec3>& velocity, const std::vector<double>& mass) {
  RigidBody body;
  body.members = members;
  Vec3 moment, momentum;
  for (const auto i : members) {
    body.mass += mass[i];
    moment += mass[i] * position[i];
    momentum += mass[i] * velocity[i];
  }
  body.centre = moment / body.mass;
  body.velocity = momentum / body.mass;
  for (const auto i : members) {
    body.offset.push_back(position[i] - body.centre);
    body.angular_momentum += mass[i] * cross(body.offset.back(), velocity[i] - body.velocity);
  }
  set_principal_axes(body, mass);
  Vec3 spin = rotate_back(body.axes, body.angular_momentum);
  for (std::size_t k = 0; k < 3; ++k) spin[k] = body.inertia[k] > 0.0 ? spin[k] / body.inertia[k] : 0.0;
  body.angular_velocity = rotate(body.axes, spin);
  return body;
}

double kinetic_energy(const std::vector<Vec3>& velocity, const std::vector<double>& mass) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += 0.5 * mass[i] * dot(velocity[i], velocity[i]);
  return sum;
}

}  // namespace tripoint
