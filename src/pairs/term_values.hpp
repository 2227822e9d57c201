// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>

#include "core/field.hpp"

/// What a pair term reads and adds, by field: i(field::viscosity) is a vector of numbers, a particle each,
/// and sum(field::force) += f * g.d() adds to three sums. A field's place is found at compile time.
namespace tripoint {

/// The fields of a term, one column after the other.
template <const auto&... fields>
struct Keys {
  static constexpr std::size_t size = (0 + ... + columns_of(fields).size());
  static constexpr std::array<const Field<double>*, size> list = [] {
    std::array<const Field<double>*, size> all{};
    std::size_t n = 0;
    [[maybe_unused]] const auto take = [&](const auto& some) {
      for (const Field<double>* f : some) all[n++] = f;
    };
    (take(columns_of(fields)), ...);
    return all;
  }();
  /// No constant where the term has not declared the field.
  static consteval std::size_t place(const Field<double>& f) {
    std::size_t k = 0;
    while (list.at(k)->key != f.key) ++k;
    return k;
  }
};

/// Places of a field among those of a term.
template <class Of>
struct Place {
  std::size_t k;
  consteval Place(const Field<double>& f) : k(Of::place(f)) {}
};
template <class Of>
struct VectorPlace {
  std::size_t x, y, z;
  consteval VectorPlace(const VectorField<double>& f)
      : x(Of::place(f.x)), y(Of::place(f.y)), z(Of::place(f.z)) {}
};
template <class Of>
struct SymmetricPlace {
  std::size_t xx, yy, zz, yz, xz, xy;
  consteval SymmetricPlace(const SymmetricField& f)
      : xx(Of::place(f.xx)),
        yy(Of::place(f.yy)),
        zz(Of::place(f.zz)),
        yz(Of::place(f.yz)),
        xz(Of::place(f.xz)),
        xy(Of::place(f.xy)) {}
};
/// Of the nine columns of a matrix, in their order.
template <class Of>
struct MatrixPlace {
  std::array<std::size_t, 9> k;
  consteval MatrixPlace(const MatrixField& f) : k{} {
    for (std::size_t n = 0; n < 9; ++n) k.at(n) = Of::place(*columns_of(f).at(n));
  }
};

/// A vector of each particle.
template <class V>
struct VectorOf {
  V x, y, z;
  [[gnu::always_inline]] friend VectorOf operator+(const VectorOf& a, const VectorOf& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend VectorOf operator-(const VectorOf& a, const VectorOf& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend VectorOf operator*(V s, const VectorOf& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  [[gnu::always_inline]] friend V dot(const VectorOf& a, const VectorOf& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
};
/// A symmetric matrix of each particle.
template <class V>
struct SymmetricOf {
  V xx, yy, zz, yz, xz, xy;
  [[gnu::always_inline]] friend SymmetricOf operator+(const SymmetricOf& a, const SymmetricOf& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
  }
  [[gnu::always_inline]] friend SymmetricOf operator*(V s, const SymmetricOf& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.yz, s * a.xz, s * a.xy};
  }
  [[gnu::always_inline]] friend VectorOf<V> operator*(const SymmetricOf& a, const VectorOf<V>& d) {
    return {a.xx * d.x + a.xy * d.y + a.xz * d.z, a.xy * d.x + a.yy * d.y + a.yz * d.z,
            a.xz * d.x + a.yz * d.y + a.zz * d.z};
  }
};
/// A matrix of each particle, row by row.
template <class V>
struct MatrixOf {
  std::array<V, 9> a;
  [[gnu::always_inline]] friend MatrixOf operator+(const MatrixOf& l, const MatrixOf& r) {
    return {l.a[0] + r.a[0], l.a[1] + r.a[1], l.a[2] + r.a[2], l.a[3] + r.a[3], l.a[4] + r.a[4],
            l.a[5] + r.a[5], l.a[6] + r.a[6], l.a[7] + r.a[7], l.a[8] + r.a[8]};
  }
  [[gnu::always_inline]] friend VectorOf<V> operator*(const MatrixOf& m, const VectorOf<V>& d) {
    return {m.a[0] * d.x + m.a[1] * d.y + m.a[2] * d.z, m.a[3] * d.x + m.a[4] * d.y + m.a[5] * d.z,
            m.a[6] * d.x + m.a[7] * d.y + m.a[8] * d.z};
  }
};
/// u w^T
template <class V>
[[gnu::always_inline]] inline MatrixOf<V> outer(const VectorOf<V>& u, const VectorOf<V>& w) {
  return {u.x * w.x, u.x * w.y, u.x * w.z, u.y * w.x, u.y * w.y, u.y * w.z, u.z * w.x, u.z * w.y, u.z * w.z};
}
/// d d^T
template <class V>
[[gnu::always_inline]] inline SymmetricOf<V> square(const VectorOf<V>& d) {
  return {d.x * d.x, d.y * d.y, d.z * d.z, d.y * d.z, d.x * d.z, d.x * d.y};
}
/// d^T a d
template <class V>
[[gnu::always_inline]] inline V quadratic(const SymmetricOf<V>& a, const VectorOf<V>& d) {
  const SymmetricOf<V> s = square(d);
  return a.xx * s.xx + a.yy * s.yy + a.zz * s.zz + 2.0 * (a.yz * s.yz + a.xz * s.xz + a.xy * s.xy);
}

/// Values of the fields that a term reads. @tparam Of the term's Keys
template <class V, class Of>
struct ValuesOf {
  std::array<V, Of::size> values;

  [[gnu::always_inline]] V operator()(Place<Of> at) const { return values[at.k]; }
  [[gnu::always_inline]] VectorOf<V> operator()(VectorPlace<Of> at) const {
    return {values[at.x], values[at.y], values[at.z]};
  }
  [[gnu::always_inline]] SymmetricOf<V> operator()(SymmetricPlace<Of> at) const {
    return {values[at.xx], values[at.yy], values[at.zz], values[at.yz], values[at.xz], values[at.xy]};
  }
  [[gnu::always_inline]] MatrixOf<V> operator()(MatrixPlace<Of> at) const {
    return {values[at.k[0]], values[at.k[1]], values[at.k[2]], values[at.k[3]], values[at.k[4]],
            values[at.k[5]], values[at.k[6]], values[at.k[7]], values[at.k[8]]};
  }
};

/// Sums that a term adds to. @tparam Of the term's Keys
template <class V, class Of>
struct SumsOf {
  std::array<V, Of::size> values;

  struct Vector {
    V &x, &y, &z;
    [[gnu::always_inline]] void operator+=(const VectorOf<V>& a) const {
      x += a.x;
      y += a.y;
      z += a.z;
    }
  };
  struct Symmetric {
    V &xx, &yy, &zz, &yz, &xz, &xy;
    [[gnu::always_inline]] void operator+=(const SymmetricOf<V>& a) const {
      xx += a.xx;
      yy += a.yy;
      zz += a.zz;
      yz += a.yz;
      xz += a.xz;
      xy += a.xy;
    }
  };
  struct Matrix {
    std::array<V, Of::size>& values;
    MatrixPlace<Of> at;
    [[gnu::always_inline]] void operator+=(const MatrixOf<V>& m) const {
      for (std::size_t n = 0; n < 9; ++n) values[at.k[n]] += m.a[n];
    }
  };
  [[gnu::always_inline]] V& operator()(Place<Of> at) { return values[at.k]; }
  [[gnu::always_inline]] Vector operator()(VectorPlace<Of> at) {
    return {values[at.x], values[at.y], values[at.z]};
  }
  [[gnu::always_inline]] Symmetric operator()(SymmetricPlace<Of> at) {
    return {values[at.xx], values[at.yy], values[at.zz], values[at.yz], values[at.xz], values[at.xy]};
  }
  [[gnu::always_inline]] Matrix operator()(MatrixPlace<Of> at) { return {values, at}; }
};

}  // namespace tripoint
