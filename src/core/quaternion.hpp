// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>

#include "core/vec3.hpp"

namespace tripoint {

/// Unit quaternion (w, x, y, z): the rotation that takes body axes to world axes.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
  constexpr bool operator==(const Quaternion&) const noexcept = default;
};

constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) noexcept {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quaternion conjugate(const Quaternion& q) noexcept { return {q.w, -q.x, -q.y, -q.z}; }
inline double norm(const Quaternion& q) noexcept {
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}
inline Quaternion normalised(const Quaternion& q) noexcept {
  const double n = norm(q);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// Rotates v by the unit quaternion q: q v q*.
constexpr Vec3 rotate(const Quaternion& q, const Vec3& v) noexcept {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
constexpr Vec3 rotate_back(const Quaternion& q, const Vec3& v) noexcept { return rotate(conjugate(q), v); }

/// Rotation by the vector a: |a| [rad] about a/|a|; the identity for a = 0.
inline Quaternion from_rotation_vector(const Vec3& a) noexcept {
  const double angle = norm(a);
  const double s = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  return {std::cos(0.5 * angle), s * a.x, s * a.y, s * a.z};
}

/// Its inverse, by the shorter way [rad].
inline Vec3 rotation_vector(const Quaternion& turn) noexcept {
  const Vec3 axis = (turn.w < 0.0 ? -1.0 : 1.0) * Vec3{turn.x, turn.y, turn.z};
  const double sine = norm(axis);
  return (sine > 0.0 ? 2.0 * std::atan2(sine, std::abs(turn.w)) / sine : 0.0) * axis;
}

/// Angle [rad] in 0..pi between two orientations, blind to the quaternion's sign: 2 atan2(|vec|, |scal|) of
/// a* b. NaN where one is zero, which is no orientation.
inline double angle_between(const Quaternion& a, const Quaternion& b) noexcept {
  const Quaternion d = conjugate(a) * b;
  if (!(norm(d) > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return 2.0 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}

/// Spherical linear interpolation from a (s = 0) to b (s = 1) along the shorter way.
inline Quaternion slerp(const Quaternion& a, Quaternion b, double s) noexcept {
  Quaternion d = conjugate(a) * b;
  if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
  const double sine = norm(Vec3{d.x, d.y, d.z});
  if (sine < 1e-300) return a;
  const double angle = 2.0 * std::atan2(sine, d.w);
  return a * from_rotation_vector((s * angle / sine) * Vec3{d.x, d.y, d.z});
}

}  // namespace tripoint
