// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "validation/metrics/frame_error.hpp"

namespace tripoint {

/// Calls f(i, j, r_j - r_i) once for each ordered pair of the given particles nearer than `reach`, nearest
/// images in periodic directions. In cells of one reach or more, so that the cost is that of the pairs.
template <class F>
void for_near_pairs(const Scene& scene, const std::vector<Vec3>& position,
                    const std::vector<std::size_t>& particles, double reach, F f) {
  using Cell = std::array<long, 3>;
  std::array<long, 3> count{};  // cells in a periodic direction; 0 = open
  Vec3 size{reach, reach, reach}, origin;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!scene.periodic[k] || !scene.min || !scene.max) continue;
    const double length = (*scene.max)[k] - (*scene.min)[k];
    count[k] = std::max(1L, static_cast<long>(length / reach));
    size[k] = length / static_cast<double>(count[k]);
    origin[k] = (*scene.min)[k];
  }
  const auto wrap = [&](Cell c) {
    for (std::size_t k = 0; k < 3; ++k)
      if (count[k] > 0) c[k] = ((c[k] % count[k]) + count[k]) % count[k];
    return c;
  };
  std::map<Cell, std::vector<std::size_t>> cells;
  for (const auto i : particles) {
    Cell c{};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = static_cast<long>(std::floor((position[i][k] - origin[k]) / size[k]));
    cells[wrap(c)].push_back(i);
  }
  for (const auto& [cell, members] : cells) {
    // Few cells in a periodic direction meet each other more than once
    std::map<Cell, const std::vector<std::size_t>*> around;
    for (long a = -1; a <= 1; ++a)
      for (long b = -1; b <= 1; ++b)
        for (long c = -1; c <= 1; ++c)
          if (const auto found = cells.find(wrap({cell[0] + a, cell[1] + b, cell[2] + c}));
              found != cells.end())
            around[found->first] = &found->second;
    for (const auto i : members)
      for (const auto& [other, list] : around)
        for (const auto j : *list) {
          if (i == j) continue;
          const Vec3 d = displacement(scene, position[j], position[i]);
          if (dot(d, d) < reach * reach) f(i, j, d);
        }
  }
}

}  // namespace tripoint
