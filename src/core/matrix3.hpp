// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/vec3.hpp"

namespace tripoint {

/// Matrix of 3x3 components by rows; the zero matrix unless said.
struct Matrix3 {
  double xx = 0.0, xy = 0.0, xz = 0.0, yx = 0.0, yy = 0.0, yz = 0.0, zx = 0.0, zy = 0.0, zz = 0.0;
  constexpr bool operator==(const Matrix3&) const noexcept = default;
};
inline constexpr Matrix3 identity3{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/// Symmetric matrix of 3x3 components.
struct Symmetric {
  double xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, xz = 0.0, xy = 0.0;
  constexpr bool operator==(const Symmetric&) const noexcept = default;
};

[[gnu::always_inline]] constexpr Vec3 operator*(const Matrix3& a, const Vec3& b) noexcept {
  return {a.xx * b.x + a.xy * b.y + a.xz * b.z, a.yx * b.x + a.yy * b.y + a.yz * b.z,
          a.zx * b.x + a.zy * b.y + a.zz * b.z};
}
constexpr Vec3 operator*(const Symmetric& a, const Vec3& b) noexcept {
  return {a.xx * b.x + a.xy * b.y + a.xz * b.z, a.xy * b.x + a.yy * b.y + a.yz * b.z,
          a.xz * b.x + a.yz * b.y + a.zz * b.z};
}
constexpr Matrix3 operator*(double s, const Matrix3& a) noexcept {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yx, s * a.yy, s * a.yz, s * a.zx, s * a.zy, s * a.zz};
}
constexpr Symmetric operator*(double s, const Symmetric& a) noexcept {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.yz, s * a.xz, s * a.xy};
}
constexpr Matrix3 operator+(const Matrix3& a, const Matrix3& b) noexcept {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
          a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
constexpr Matrix3 operator-(const Matrix3& a, const Matrix3& b) noexcept { return a + (-1.0) * b; }
constexpr Symmetric operator+(const Symmetric& a, const Symmetric& b) noexcept {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}
constexpr Symmetric operator-(const Symmetric& a, const Symmetric& b) noexcept { return a + (-1.0) * b; }

constexpr Matrix3 full(const Symmetric& a) noexcept {
  return {a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz};
}
constexpr Matrix3 transposed(const Matrix3& a) noexcept {
  return {a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz};
}
[[gnu::always_inline]] constexpr Matrix3 operator*(const Matrix3& a, const Matrix3& b) noexcept {
  const Vec3 x = a * Vec3{b.xx, b.yx, b.zx}, y = a * Vec3{b.xy, b.yy, b.zy}, z = a * Vec3{b.xz, b.yz, b.zz};
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}
constexpr Matrix3 operator*(const Matrix3& a, const Symmetric& b) noexcept { return a * full(b); }
/// a b^T
constexpr Matrix3 outer(const Vec3& a, const Vec3& b) noexcept {
  return {a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y, a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z};
}
/// a a^T
constexpr Symmetric square(const Vec3& a) noexcept {
  return {a.x * a.x, a.y * a.y, a.z * a.z, a.y * a.z, a.x * a.z, a.x * a.y};
}
/// (a + a^T)/2
constexpr Symmetric symmetric_part(const Matrix3& a) noexcept {
  return {a.xx, a.yy, a.zz, 0.5 * (a.yz + a.zy), 0.5 * (a.xz + a.zx), 0.5 * (a.xy + a.yx)};
}
constexpr double trace(const Symmetric& a) noexcept { return a.xx + a.yy + a.zz; }
/// a - (tr a/3) I
constexpr Symmetric deviator(const Symmetric& a) noexcept {
  const double mean = trace(a) / 3.0;
  return a - Symmetric{mean, mean, mean, 0.0, 0.0, 0.0};
}
/// a : b, the full contraction
constexpr double contraction(const Symmetric& a, const Symmetric& b) noexcept {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.yz * b.yz + a.xz * b.xz + a.xy * b.xy);
}
/// P a P
constexpr Symmetric between(const Symmetric& P, const Symmetric& a) noexcept {
  return symmetric_part(full(P) * (full(a) * P));
}
constexpr double determinant(const Matrix3& a) noexcept {
  return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) +
         a.xz * (a.yx * a.zy - a.yy * a.zx);
}
/// By cofactors; infinite or not a number where det a = 0.
constexpr Matrix3 inverse(const Matrix3& a) noexcept {
  const double per_det = 1.0 / determinant(a);
  return per_det * Matrix3{a.yy * a.zz - a.yz * a.zy, a.xz * a.zy - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy,
                           a.yz * a.zx - a.yx * a.zz, a.xx * a.zz - a.xz * a.zx, a.xz * a.yx - a.xx * a.yz,
                           a.yx * a.zy - a.yy * a.zx, a.xy * a.zx - a.xx * a.zy, a.xx * a.yy - a.xy * a.yx};
}

}  // namespace tripoint
