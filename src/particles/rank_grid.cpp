// SPDX-License-Identifier: BSD-3-Clause
#include "particles/rank_grid.hpp"

#include <limits>

namespace tripoint {

std::array<int, 3> rank_grid(int ranks, const Vec3& length, const std::array<bool, 3>& periodic) {
  std::array<int, 3> best{ranks, 1, 1};
  double least = std::numeric_limits<double>::infinity();
  for (int x = 1; x <= ranks; ++x) {
    if (ranks % x != 0) continue;
    for (int y = 1; x * y <= ranks; ++y) {
      if (ranks % (x * y) != 0) continue;
      const std::array<int, 3> grid{x, y, ranks / (x * y)};
      double area = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        const int cuts = periodic[a] && grid[a] > 1 ? grid[a] : grid[a] - 1;
        area += cuts * length[(a + 1) % 3] * length[(a + 2) % 3];
      }
      if (area < least) {
        least = area;
        best = grid;
      }
    }
  }
  return best;
}

}  // namespace tripoint
