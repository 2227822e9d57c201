// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "surface/cell_table.hpp"

namespace tripoint {

/// A box with faces along the axes [m].
struct Box {
  Vec3 low, high;
  [[nodiscard]] bool holds(const Vec3& r) const noexcept {
    return r.x >= low.x && r.x <= high.x && r.y >= low.y && r.y <= high.y && r.z >= low.z && r.z <= high.z;
  }
};

/// The box grown by d on every side.
[[nodiscard]] inline Box grown(const Box& b, double d) noexcept {
  return {b.low - Vec3{d, d, d}, b.high + Vec3{d, d, d}};
}

/// The least box around points; low above high where there is none.
[[nodiscard]] Box box_around(std::span<const Vec3> points) noexcept;

/// Points that may be near to any place of a cell, ready for whole vectors: padded with places too far away
/// to count.
struct NearPoints {
  std::vector<double> x, y, z;     ///< [m]
  std::vector<std::uint32_t> row;  ///< of the points, without the padding
  [[nodiscard]] bool empty() const noexcept { return row.empty(); }
};

/// Points sorted into cubic cells, to be asked about any place. `Neighbours` lists pairs of particles that
/// move. This is built once for points that stay, and takes places where no particle is.
class PointCells {
 public:
  /// @param side of a cell [m]
  /// @throws InputError where a point is not finite, or points lie more than 2^20 cells apart
  PointCells(std::span<const Vec3> points, double side);

  [[nodiscard]] CellIndex cell_of(const Vec3& r) const noexcept;
  [[nodiscard]] Box box_of(const CellIndex&) const noexcept;
  [[nodiscard]] double side() const noexcept { return side_; }
  [[nodiscard]] std::size_t size() const noexcept { return row_.size(); }
  /// Around all points [m].
  [[nodiscard]] const Box& box() const noexcept { return box_; }
  /// Cells that hold a point, in the order of their keys.
  [[nodiscard]] std::span<const std::uint64_t> occupied() const noexcept { return keys_; }

  /// Points within reach of a cell's box, in the order (cell, row), whatever the threads.
  /// @param reach [m]   @param out is replaced
  void gather(const CellIndex&, double reach, NearPoints& out) const;

 private:
  double side_;
  Vec3 origin_;
  Box box_;
  std::vector<std::uint64_t> keys_;   // of the occupied cells, ascending
  std::vector<std::uint32_t> first_;  // first point of each occupied cell, one more at the end
  std::vector<double> x_, y_, z_;     // by (cell, row)
  std::vector<std::uint32_t> row_;
  CellTable table_;
};

/// Result of PointCells::gather for the cells that one thread asked about last.
class NearCache {
 public:
  /// @param cells must outlive it   @param reach of the points around a place [m]
  NearCache(const PointCells& cells, double reach) : cells_(&cells), reach_(reach), entries_(slots) {}
  /// Every point within reach of the place, and some further ones.
  [[nodiscard]] const NearPoints& around(const Vec3& r);

 private:
  static constexpr std::size_t slots = 1024;
  struct Entry {
    CellIndex cell{};
    bool filled = false;
    NearPoints points;
  };
  const PointCells* cells_;
  double reach_;
  std::vector<Entry> entries_;
};

}  // namespace tripoint
