// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/rotation.hpp"

namespace tripoint {
namespace {

double inverse(double moment) noexcept { return moment > 0.0 ? 1.0 / moment : 0.0; }

/// Turns the body about its own axis k by L_k dt times an inverse moment: the exact motion of that part of
/// the energy.
Quaternion turned_about(std::size_t k, const Quaternion& q, double inverse_moment, const Vec3& L,
                        double dt) noexcept {
  Vec3 turn;
  turn[k] = rotate_back(q, L)[k] * inverse_moment * dt;
  return q * from_rotation_vector(turn);
}

}  // namespace

Vec3 angular_velocity(const Quaternion& to_world, const Vec3& moments, const Vec3& L) noexcept {
  const Vec3 l = rotate_back(to_world, L);
  return rotate(to_world, {l.x * inverse(moments.x), l.y * inverse(moments.y), l.z * inverse(moments.z)});
}

double rotation_energy(const Quaternion& to_world, const Vec3& moments, const Vec3& L) noexcept {
  const Vec3 l = rotate_back(to_world, L);
  return 0.5 *
         (l.x * l.x * inverse(moments.x) + l.y * l.y * inverse(moments.y) + l.z * l.z * inverse(moments.z));
}

Quaternion rotated_paper(const Quaternion& to_world, const Vec3& moments, const Vec3& L, double dt) noexcept {
  return normalised(from_rotation_vector(dt * angular_velocity(to_world, moments, L)) * to_world);
}

Quaternion rotated_corrected(const Quaternion& to_world, const Vec3& moments, const Vec3& L,
                             double dt) noexcept {
  const double isotropic = inverse(moments.y);  // moments ascend: y is the middle one
  const double least = inverse(moments.x) - isotropic, greatest = inverse(moments.z) - isotropic;
  Quaternion q = from_rotation_vector(isotropic * dt * L) * to_world;
  q = turned_about(2, q, greatest, L, 0.5 * dt);
  q = turned_about(0, q, least, L, dt);
  q = turned_about(2, q, greatest, L, 0.5 * dt);
  return normalised(q);
}

Quaternion rotated_no_squish(const Quaternion& to_world, const Vec3& moments, const Vec3& L, double dt,
                             const AxisOrder& order) noexcept {
  const auto [outer, middle, inner] = order;
  const Vec3 w{inverse(moments.x), inverse(moments.y), inverse(moments.z)};
  Quaternion q = turned_about(outer, to_world, w[outer], L, 0.5 * dt);
  q = turned_about(middle, q, w[middle], L, 0.5 * dt);
  q = turned_about(inner, q, w[inner], L, dt);
  q = turned_about(middle, q, w[middle], L, 0.5 * dt);
  q = turned_about(outer, q, w[outer], L, 0.5 * dt);
  return normalised(q);
}

/// Moment of inertia over M spacing^2 below which it becomes 0 [1]: a choice, that of a body about sqrt(2e-3)
/// = 4.5 % of a spacing thin.
constexpr double thin_moment = 2e-3;

Vec3 truncated(const Vec3& moments, double mass, double spacing) noexcept {
  const double least = thin_moment * mass * spacing * spacing;
  return {moments.x < least ? 0.0 : moments.x, moments.y < least ? 0.0 : moments.y,
          moments.z < least ? 0.0 : moments.z};
}

}  // namespace tripoint
