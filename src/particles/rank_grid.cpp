// SPDX-License-Identifier: BSD-3-Clause
#include "particles/rank_grid.hpp"

#include <algorithm>

namespace tripoint {
namespace {

/// particles; of more, so many are looked at, evenly spread over the list
constexpr std::size_t most_looked_at = 200'000;

/// Particles of a rank below which they say nothing of how evenly space is shared out: cuts lie between their
/// layers.
constexpr std::size_t least_of_a_rank = 64;
constexpr std::size_t most_tried = 16;  ///< grids, those with the least area of cuts

/// Area of all cuts through a box [m2].
double area_of(const std::array<int, 3>& grid, const Vec3& length, const std::array<bool, 3>& periodic) {
  double area = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const int cuts = periodic[a] && grid[a] > 1 ? grid[a] : grid[a] - 1;
    area += cuts * length[(a + 1) % 3] * length[(a + 2) % 3];
  }
  return area;
}

/// All ways to lay so many ranks, the least area of cuts first.
std::vector<std::array<int, 3>> grids_by_area(int ranks, const ToShareOut& what) {
  Vec3 low = what.places.front(), high = low;
  for (const Vec3& r : what.places)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], r[a]);
      high[a] = std::max(high[a], r[a]);
    }
  const Vec3 length = high - low + Vec3{what.spacing, what.spacing, what.spacing};
  std::vector<std::array<int, 3>> grids;
  for (int x = 1; x <= ranks; ++x) {
    if (ranks % x != 0) continue;
    for (int y = 1; x * y <= ranks; ++y)
      if (ranks % (x * y) == 0) grids.push_back({x, y, ranks / (x * y)});
  }
  std::ranges::stable_sort(grids, {}, [&](const auto& grid) { return area_of(grid, length, what.periodic); });
  return grids;
}

/// The greatest number of ghosts of a part along one direction.
double most_copies(const ToShareOut& what, const Cuts& cuts, std::size_t a) {
  if (!cuts.cut(a)) return 0.0;
  const std::vector<double>& at = cuts.at[a];
  const int parts = cuts.grid[a];
  std::vector<double> ghosts(static_cast<std::size_t>(parts), 0.0);
  const double width = at.back() - at.front();
  const auto bound = [&](int n) {  // of part n from below, and beyond the ends of a periodic direction
    const int turn = n >= 0 ? n / parts : -((parts - 1 - n) / parts);
    return at[static_cast<std::size_t>(n - turn * parts)] + turn * width;
  };
  const auto add = [&](int n) {
    if (what.periodic[a] || (n >= 0 && n < parts))
      ghosts[static_cast<std::size_t>((n % parts + parts) % parts)] += 1.0;
  };
  for (const Vec3& r : what.places) {
    const auto part = static_cast<int>(std::upper_bound(at.begin() + 1, at.end() - 1, r[a]) - at.begin()) - 1;
    for (int n = part - 1; n > part - parts && r[a] - bound(n + 1) < what.reach; --n) add(n);
    for (int n = part + 1; n < part + parts && bound(n) - r[a] < what.reach; ++n) add(n);
  }
  return std::ranges::max(ghosts);
}

/// Predicted cost of a step, in entries.
double predicted_step(const ToShareOut& what, const Cuts& cuts) {
  const int ranks = cuts.grid[0] * cuts.grid[1] * cuts.grid[2];
  std::vector<double> rows(static_cast<std::size_t>(ranks), 0.0), entries = rows;
  for (std::size_t i = 0; i < what.places.size(); ++i) {
    const std::size_t rank = cuts.rank_of(what.places[i]);
    rows[rank] += 1.0;
    entries[rank] += what.is_idle(i) ? 0.0 : ParticleCost::busy_at_start - ParticleCost::idle_at_start;
  }
  double ghosts = 0.0;
  for (std::size_t a = 0; a < 3; ++a) ghosts += most_copies(what, cuts, a) * cuts.grid[a] / ranks;
  return ParticleCost::at_start(true) * std::ranges::max(rows) + ParticleCost::of_row() * ghosts +
         std::ranges::max(entries);
}

}  // namespace

std::array<int, 3> rank_grid(int ranks, const ToShareOut& what) {
  if (ranks == 1 || what.places.empty()) return {ranks, 1, 1};
  std::vector<std::array<int, 3>> grids = grids_by_area(ranks, what);
  if (what.places.size() < least_of_a_rank * static_cast<std::size_t>(ranks)) return grids.front();
  grids.resize(std::min(grids.size(), most_tried));
  ToShareOut some = what;
  std::vector<Vec3> places;
  std::vector<char> idle;
  const std::size_t every = what.places.size() / most_looked_at + 1;
  for (std::size_t i = 0; every > 1 && i < what.places.size(); i += every) {
    places.push_back(what.places[i]);
    idle.push_back(what.is_idle(i) ? 1 : 0);
  }
  if (every > 1) {
    some.places = places;
    some.idle = idle;
  }
  return *std::ranges::min_element(
      grids, {}, [&](const auto& grid) { return predicted_step(some, cuts_of(some, grid)); });
}

}  // namespace tripoint
