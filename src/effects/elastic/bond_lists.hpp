// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "particles/pair_lists.hpp"

namespace tripoint::elastic {

/// Data that bonds of one reference vector share: a line of the cache. Bonds of a lattice have few such
/// vectors.
struct alignas(vector_bytes) BondShape {
  Vec3 x;              ///< reference vector x_ij [m]
  double slope = 0.0;  ///< grad W(x_ij) = slope x_ij [1/m5]
  /// Bond::gradient: slope x_ij, but at a surface that is corrected for bending [1/m4]
  Vec3 gradient;
  double hourglass = 0.0;  ///< W(x_ij)/|x_ij|^2 [1/m5]
  bool operator==(const BondShape&) const noexcept = default;
};
static_assert(sizeof(BondShape) == vector_bytes);

/// The lists of bonds as the passes stream them: 12 bytes a bond, and what bonds have in common once. Memory
/// that is made from State::bonds and follows it; no state of its own.
class BondLists {
 public:
  /// One list, in the order of State::bonds.
  struct List {
    const std::uint32_t* other;  ///< id of j
    const std::uint32_t* shape;  ///< of the bond in this list
    const std::uint32_t* seen;   ///< of its twin, in the list of j
    std::size_t count;
  };
  /// @return whether there was anything new
  bool follow(const Bonds&);
  [[nodiscard]] List of(const Bonds& bonds, std::size_t id) const {
    const std::size_t start = id < bonds.particles() ? bonds.start(id) : 0;
    return {other_.data() + start, shape_.data() + start, seen_.data() + start, bonds.of(id).size()};
  }
  [[nodiscard]] const BondShape* shapes() const noexcept { return shapes_.data(); }

 private:
  [[nodiscard]] std::uint32_t shape_of(const Bond&);
  void make_room();
  void clear();

  std::vector<std::uint32_t> other_, shape_, seen_;  ///< by place in the pool of State::bonds
  AlignedVector<BondShape> shapes_;
  /// Open addressing: 1 + the shape with this hash, a power of two of places
  std::vector<std::uint32_t> table_;
  std::uint64_t followed_ = 0;  ///< changes of State::bonds until now
};

}  // namespace tripoint::elastic
