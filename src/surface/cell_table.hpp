// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace tripoint {

/// A cell of an unbounded grid, counted from the cell at its origin.
using CellIndex = std::array<std::int32_t, 3>;

/// Numbers for the occupied cells of an unbounded grid. Memory follows their number, not the room they lie
/// in: a drop that has flown far costs no more than one that has not.
class CellTable {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// Cells are numbered from -most to most - 1 along each axis
  static constexpr std::int32_t most = 1 << 20;

  /// @param cells that it has room for without growing
  explicit CellTable(std::size_t cells) : slots_(std::bit_ceil(2 * cells + 2)) {}

  /// 21 bits a component, in the order of x, y, z.
  [[nodiscard]] static std::uint64_t key(const CellIndex& c) noexcept {
    const auto part = [&](std::size_t a) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(c[a] + most));
    };
    return part(0) << 42 | part(1) << 21 | part(2);
  }
  [[nodiscard]] static CellIndex cell(std::uint64_t key) noexcept {
    const auto part = [&](int shift) { return static_cast<std::int32_t>(key >> shift & 0x1fffffU) - most; };
    return {part(42), part(21), part(0)};
  }

  /// Stores a number for a cell that has none yet, else keeps the first. @return whether it was stored
  bool insert(std::uint64_t key, std::uint32_t number) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place_of(key)];
    if (slot.number != none) return false;
    slot = {key, number};
    ++size_;
    return true;
  }
  /// @return the number of a cell, or none
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const noexcept { return slots_[place_of(key)].number; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = none;
  };
  /// The slot that holds the key, or the empty one where it belongs.
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15ULL >> 20) & mask;
    while (slots_[at].number != none && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    std::vector<Slot> before(2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before)
      if (slot.number != none) slots_[place_of(slot.key)] = slot;
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace tripoint
