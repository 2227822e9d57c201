// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/matrix3.hpp"
#include "particles/catalogue.hpp"
#include "particles/columns.hpp"

namespace tripoint {

/// The particles of a scene. Rows are in order of the neighbour grid's cells; ids are for ever. Where members
/// of fixed bodies can sleep, moving particles have the first rows, then come the fixed particles that a step
/// reads. Each of the two has that order. Sleeping particles come last: nothing that moves can reach them, or
/// they act by their place alone (decisions 020 and 028).
class Particles : public Columns {
 public:
  Particles() = default;
  /// Particles 0..count-1, in rows of the same number. @param fields every field that the scene's effects own
  Particles(std::size_t count, std::span<const FieldInfo> fields);

  /// Other particles in the same columns. Particle n has the values of the old row rows[n]; where that is
  /// `none` the caller must write them. number() is to be called then.
  void make_of(std::span<const std::uint32_t> rows) { gather(rows); }
  /// Row n is of particle n from now on.
  void number();

  /// Row of the particle with this id, which is in 0..size()-1.
  [[nodiscard]] std::size_t row(std::size_t id) const noexcept { return row_of_id_[id]; }
  [[nodiscard]] std::span<const std::uint32_t> rows() const noexcept { return row_of_id_; }  ///< of each id
  /// Rows 0..moving()-1 are of particles that are not known to be fixed: forces, velocities and places are
  /// theirs.
  [[nodiscard]] std::size_t moving() const noexcept { return moving_; }
  /// Rows 0..awake()-1 take part in a step.
  [[nodiscard]] std::size_t awake() const noexcept { return awake_; }
  /// One particle more, all zero, with the next id. @return its row
  std::size_t append();
  /// Reorders every column and the map from ids to rows.
  void permute(std::span<const std::uint32_t> order, int threads = 1);
  /// Columns::rearrange() with the map from ids to rows. @param moving,awake as they return from now on
  void rearrange(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, std::size_t moving,
                 std::size_t awake, int threads);

  [[nodiscard]] Vec3 position(std::size_t row) const { return vector(row, field::position); }
  [[nodiscard]] Vec3 velocity(std::size_t row) const { return vector(row, field::velocity); }
  [[nodiscard]] Vec3 vector(std::size_t row, const VectorField<double>& f) const {
    return {(*this)[f.x][row], (*this)[f.y][row], (*this)[f.z][row]};
  }

 private:
  std::vector<std::uint32_t> row_of_id_;
  std::size_t moving_ = 0, awake_ = 0;
};

/// Three columns of a vector field.
template <class T>
struct Triple {
  std::span<T> x, y, z;
  [[nodiscard]] Vec3 at(std::size_t row) const {
    return {static_cast<double>(x[row]), static_cast<double>(y[row]), static_cast<double>(z[row])};
  }
  void set(std::size_t row, const Vec3& v) const {
    x[row] = v.x;
    y[row] = v.y;
    z[row] = v.z;
  }
};
template <class T, class P>
[[nodiscard]] auto triple(P& particles, const Field<T>& x, const Field<T>& y, const Field<T>& z) {
  return Triple<std::conditional_t<std::is_const_v<P>, const T, T>>{particles[x], particles[y], particles[z]};
}
template <class T, class P>
[[nodiscard]] auto triple(P& particles, const VectorField<T>& f) {
  return triple(particles, f.x, f.y, f.z);
}
/// Six columns of a symmetric field.
template <class T>
struct SymmetricColumns {
  std::span<T> xx, yy, zz, yz, xz, xy;
  [[nodiscard]] Symmetric at(std::size_t row) const {
    return {xx[row], yy[row], zz[row], yz[row], xz[row], xy[row]};
  }
  void set(std::size_t row, const Symmetric& e) const {
    xx[row] = e.xx;
    yy[row] = e.yy;
    zz[row] = e.zz;
    yz[row] = e.yz;
    xz[row] = e.xz;
    xy[row] = e.xy;
  }
};
template <class P>
[[nodiscard]] auto symmetric_columns(P& p, const SymmetricField& f) {
  return SymmetricColumns<std::conditional_t<std::is_const_v<P>, const double, double>>{
      p[f.xx], p[f.yy], p[f.zz], p[f.yz], p[f.xz], p[f.xy]};
}
/// Nine columns of a matrix field, row by row.
template <class T>
struct MatrixColumns {
  std::array<std::span<T>, 9> a;
  [[nodiscard]] Matrix3 at(std::size_t row) const {
    return {a[0][row], a[1][row], a[2][row], a[3][row], a[4][row],
            a[5][row], a[6][row], a[7][row], a[8][row]};
  }
  void set(std::size_t row, const Matrix3& m) const {
    const std::array<double, 9> parts{m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz};
    for (std::size_t k = 0; k < 9; ++k) a[k][row] = parts[k];
  }
};
template <class P>
[[nodiscard]] auto matrix_columns(P& p, const MatrixField& f) {
  return MatrixColumns<std::conditional_t<std::is_const_v<P>, const double, double>>{
      {p[f.xx], p[f.xy], p[f.xz], p[f.yx], p[f.yy], p[f.yz], p[f.zx], p[f.zy], p[f.zz]}};
}
template <class P>
[[nodiscard]] auto positions(P& p) {
  return triple(p, field::position);
}
template <class P>
[[nodiscard]] auto velocities(P& p) {
  return triple(p, field::velocity);
}
template <class P>
[[nodiscard]] auto images(P& p) {
  return triple(p, field::image);
}

/// The fields that the particles of every scene have.
[[nodiscard]] std::vector<FieldInfo> common_fields(bool periodic);

}  // namespace tripoint
