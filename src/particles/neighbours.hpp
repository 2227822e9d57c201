// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"

namespace tripoint {

/// The domain where it is periodic.
struct PeriodicBox {
  std::array<bool, 3> periodic{};
  Vec3 min, width;  ///< [m], used in periodic directions only
  [[nodiscard]] bool any() const noexcept { return periodic[0] || periodic[1] || periodic[2]; }
};

/// An entry of a neighbour list: the row of j in the low 26 bits, whether i and j are an own pair and, above, the image of the box
/// that j is seen in.
struct Entry {
  std::uint32_t bits;
  static constexpr std::uint32_t row_bits = 26, row_mask = (1u << row_bits) - 1, own_bit = 1u << row_bits, image_shift = row_bits + 1;
  [[nodiscard]] constexpr std::uint32_t row() const noexcept { return bits & row_mask; }
  [[nodiscard]] constexpr bool own() const noexcept { return (bits & own_bit) != 0; }  ///< members of one deformable body
  [[nodiscard]] constexpr std::uint32_t image() const noexcept { return bits >> image_shift; }  ///< 0..26, 13 = the box itself
};

/// Full directed lists: every i lists all its j within support + skin, ordered by (cell, id) at the last rebuild, so that
/// a sum over them has the same bits whatever the threads or the order of particles before. Periodic images count each;
/// a particle may be its own neighbour through the seam.
class Neighbours {
 public:
  /// @param support radius beyond which pairs do nothing [m]
  /// @param skin kept around it, so that lists last; 0 for particles that never move [m]
  /// @throws InputError when a periodic direction is narrower than support + skin
  Neighbours(double support, double skin, const PeriodicBox& box, int threads);

  /// Sorts the particles and lists them anew when one has moved by more than skin/2 since the last time.
  /// @throws Diverged when a position is not finite
  /// @return whether the rows have a new order
  bool update(Particles&, double time);
  /// Lists the particles anew from the positions of an earlier rebuild, as a restart must to continue the same bits.
  /// @param build_positions by row of `particles`, as build_positions() gave them
  /// @param rebuilds as counted until then
  void rebuild_from(Particles&, std::span<const Vec3> build_positions, double time, long rebuilds = 1);

  /// Marks the entries of own pairs; to be called after a rebuild and after a change of these lists.
  void mark_own(const Particles&, const OwnPairs&);
  /// Whether that was done since the last rebuild.
  [[nodiscard]] bool marked() const noexcept { return marked_; }

  [[nodiscard]] std::span<const Entry> of(std::size_t i) const {
    return {entries_.data() + start_[i], start_[i + 1] - start_[i]};
  }
  /// r_j - r_i of an entry is (x_j - x_i) + shift: in this order it is exactly antisymmetric in i and j.
  [[nodiscard]] const Vec3& shift(std::uint32_t image) const noexcept { return shift_[image]; }
  [[nodiscard]] double support() const noexcept { return support_; }
  [[nodiscard]] std::size_t entries() const noexcept { return entries_.size(); }
  [[nodiscard]] long rebuilds() const noexcept { return rebuilds_; }
  [[nodiscard]] std::span<const Vec3> build_positions() const noexcept { return built_; }

 private:
  struct Grid;
  [[nodiscard]] bool outdated(const Particles&) const;
  void wrap(Particles&) const;
  void rebuild(Particles&, double time);
  void sort_and_list(Particles&);
  void list(const Particles&, const Grid&);

  double support_, skin_;
  PeriodicBox box_;
  int threads_;
  std::array<Vec3, 27> shift_{};
  std::vector<std::size_t> start_;
  std::vector<Entry> entries_;
  std::vector<Vec3> built_;
  long rebuilds_ = 0;
  bool marked_ = false;
};

}  // namespace tripoint
