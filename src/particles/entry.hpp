// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

namespace tripoint {

/// An entry of a neighbour list. The low 26 bits are the row of j. The bits from 27 on are the periodic image
/// in which j is seen. Lists keep excluded pairs in a separate column (Clusters::own). RowEntries sets it
/// between the two while a caller walks the entries of one row.
struct Entry {
  std::uint32_t bits;
  static constexpr std::uint32_t row_bits = 26, row_mask = (1u << row_bits) - 1, own_bit = 1u << row_bits,
                                 image_shift = row_bits + 1;
  static constexpr std::uint32_t box_itself = 13;  ///< the image that is not moved
  [[nodiscard]] static constexpr Entry of(std::uint32_t row, std::uint32_t image) noexcept {
    return {row | image << image_shift};
  }
  [[nodiscard]] constexpr std::uint32_t row() const noexcept { return bits & row_mask; }
  /// Members of one deformable body
  [[nodiscard]] constexpr bool own() const noexcept { return (bits & own_bit) != 0; }
  [[nodiscard]] constexpr std::uint32_t image() const noexcept { return bits >> image_shift; }  ///< 0..26
};

inline constexpr std::size_t within_bits = 64;  ///< of a word of Clusters::within
/// Word of Clusters::within that a cluster begins with. @param start its first entry
[[nodiscard]] constexpr std::size_t within_start(std::size_t start, std::size_t cluster) noexcept {
  return start / within_bits + cluster;
}

}  // namespace tripoint
