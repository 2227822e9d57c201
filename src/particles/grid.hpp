// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "particles/neighbours.hpp"

namespace tripoint {

/// Cells are finer than the reach of the lists, most of all in x, whose index runs fastest. The numbers are
/// measured. The particles of a cluster are then near each other, and their neighbours fill few whole rows of
/// cells.
struct Neighbours::Grid {
  static constexpr std::array<double, 3> cells_a_reach{6.0, 1.5, 1.5};
  static constexpr int cells_a_stretch = 6;  ///< see Neighbours::Still
  static constexpr double tolerance = 1e-9;  ///< of the reach, far above the rounding of cell numbers

  std::array<int, 3> count{1, 1, 1};
  std::array<int, 3> skipped{};  ///< cells between the origin and the first of these, of a part of a scene
  Vec3 origin, width;
  std::vector<std::uint32_t> first;  // row that starts each cell, one more at the end

  [[nodiscard]] std::size_t index(const std::array<int, 3>& c) const {
    return static_cast<std::size_t>(c[0]) +
           static_cast<std::size_t>(count[0]) *
               (static_cast<std::size_t>(c[1]) +
                static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(c[2]));
  }
  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(count[0]) * count[1] * count[2]; }
  [[nodiscard]] std::array<int, 3> place(const Vec3& r) const {
    std::array<int, 3> c{};
    for (std::size_t a = 0; a < 3; ++a)
      c[a] = std::clamp(static_cast<int>((r[a] - origin[a]) / width[a]) - skipped[a], 0, count[a] - 1);
    return c;
  }

  [[nodiscard]] static std::array<int, 3> stretch(const std::array<int, 3>& c) {
    return {c[0] / cells_a_stretch, c[1], c[2]};
  }

  /// @param low, high corners of all positions   @param reach of a list
  static Grid over(const Vec3& low, const Vec3& high, double reach, const PeriodicBox& box,
                   std::size_t particles) {
    Grid g;
    // A particle far away must not ask for a mountain of empty cells: then all become wider.
    const double most_cells = 16.0 * static_cast<double>(particles) + 1024.0;
    for (double scale = 1.0;; scale *= 2.0) {
      double cells = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double least = scale * reach / cells_a_reach[a];
        const double extent = box.periodic[a] ? box.width[a] : std::max(high[a] - low[a], 0.0);
        const double n = std::max(1.0, std::floor(extent / least) + (box.periodic[a] ? 0.0 : 1.0));
        g.origin[a] = box.periodic[a] ? box.min[a] : low[a];
        g.width[a] = box.periodic[a] ? extent / n : least;
        g.count[a] = static_cast<int>(std::min(n, 1e9));
        cells *= n;
      }
      if (cells <= most_cells) return g;
    }
  }

  /// Keeps the cells of a whole scene that its part between these corners touches: never more than the whole
  /// has.
  void keep(const Vec3& low, const Vec3& high, const PeriodicBox& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (box.periodic[a]) continue;
      skipped[a] = static_cast<int>((low[a] - origin[a]) / width[a]);
      count[a] = static_cast<int>((high[a] - origin[a]) / width[a]) - skipped[a] + 1;
    }
  }

  /// Cells along an axis, least to most; beyond 0..count-1 in periodic directions, where they mean images.
  struct Axis {
    double origin, cells_a_length;
    int skipped, least, most;
    /// Numbers of the cells that [low, high] touches. They are cut off before they become whole: what is not
    /// below zero does so without a call.
    [[nodiscard]] std::array<int, 2> touched(double low, double high) const {
      return {cell_of(low), cell_of(high)};
    }

   private:
    [[nodiscard]] int cell_of(double x) const {
      const double cell = (x - origin) * cells_a_length - static_cast<double>(skipped + least);
      return static_cast<int>(std::min(std::max(cell, 0.0), static_cast<double>(most - least))) + least;
    }
  };
  [[nodiscard]] Axis axis(std::size_t a, bool periodic) const {
    return {origin[a], 1.0 / width[a], skipped[a], periodic ? -count[a] : 0,
            periodic ? 2 * count[a] - 1 : count[a] - 1};
  }
  [[nodiscard]] int image(std::size_t a, int cell) const { return cell < 0 ? -1 : cell >= count[a] ? 1 : 0; }
  /// Distance of an interval to a cell along an axis; 0 where they touch.
  [[nodiscard]] double gap(std::size_t a, int cell, double low, double high) const {
    const double begin = origin[a] + (cell + skipped[a]) * width[a], end = begin + width[a];
    return std::max({0.0, begin - high, low - end});
  }

  /// The rows of cells within reach of a box, in the order of cells.
  void candidates(const Vec3& low, const Vec3& high, double reach, const PeriodicBox& box,
                  std::vector<CandidateRange>& ranges) const {
    ranges.clear();
    const double wide = reach * (1.0 + tolerance);
    const Axis along_x = axis(0, box.periodic[0]);
    const auto zs = axis(2, box.periodic[2]).touched(low.z - wide, high.z + wide),
               ys = axis(1, box.periodic[1]).touched(low.y - wide, high.y + wide);
    for (int z = zs[0]; z <= zs[1]; ++z) {
      const double dz = gap(2, z, low.z, high.z);
      for (int y = ys[0]; y <= ys[1]; ++y) {
        const double dy = gap(1, y, low.y, high.y), left = wide * wide - dy * dy - dz * dz;
        if (left < 0.0) continue;
        const double along = std::sqrt(left);
        add_row(along_x.touched(low.x - along, high.x + along), y, z, ranges);
      }
    }
  }

 private:
  [[gnu::always_inline]] void add_row(const std::array<int, 2>& xs, int y, int z,
                                      std::vector<CandidateRange>& ranges) const {
    const int iy = image(1, y), iz = image(2, z);
    const std::uint32_t* const row = first.data() + index({0, y - iy * count[1], z - iz * count[2]});
    for (int ix = image(0, xs[0]); ix <= image(0, xs[1]); ++ix) {
      const int from = std::max(xs[0] - ix * count[0], 0), to = std::min(xs[1] - ix * count[0], count[0] - 1);
      if (row[from] != row[to + 1])
        ranges.push_back(
            {row[from], row[to + 1], Entry::box_itself + static_cast<std::uint32_t>(ix + 3 * iy + 9 * iz)});
    }
  }
};

}  // namespace tripoint
