// SPDX-License-Identifier: BSD-3-Clause
#include "particles/rank_grid.hpp"

#include <algorithm>
#include <limits>

namespace tripoint {
namespace {

constexpr std::size_t most_looked_at = 200'000;  ///< particles; of more, so many are looked at, evenly spread over the list

/// What the greatest number of copies of a part along one direction is, by the particles near its two planes.
double most_copies(const ToShareOut& what, const Cuts& cuts, std::size_t a) {
  if (!cuts.cut(a)) return 0.0;
  std::vector<double> copies(static_cast<std::size_t>(cuts.grid[a]), 0.0);
  const std::vector<double>& at = cuts.at[a];
  const auto last = static_cast<std::ptrdiff_t>(copies.size()) - 1;
  const auto add = [&](std::ptrdiff_t part) {
    if (part >= 0 && part <= last) copies[static_cast<std::size_t>(part)] += 1.0;
    if (what.periodic[a] && (part < 0 || part > last)) copies[static_cast<std::size_t>(part < 0 ? last : 0)] += 1.0;
  };
  for (const Vec3& r : what.places) {
    const std::ptrdiff_t part = std::upper_bound(at.begin() + 1, at.end() - 1, r[a]) - at.begin() - 1;
    if (r[a] - at[static_cast<std::size_t>(part)] < what.reach) add(part - 1);
    if (at[static_cast<std::size_t>(part) + 1] - r[a] < what.reach) add(part + 1);
  }
  return std::ranges::max(copies);
}

/// What a step takes, in entries.
double predicted_step(const ToShareOut& what, const Cuts& cuts) {
  const int ranks = cuts.grid[0] * cuts.grid[1] * cuts.grid[2];
  std::vector<double> rows(static_cast<std::size_t>(ranks), 0.0), entries = rows;
  for (std::size_t i = 0; i < what.places.size(); ++i) {
    const std::size_t rank = cuts.rank_of(what.places[i]);
    rows[rank] += 1.0;
    entries[rank] += what.is_idle(i) ? 0.0 : ParticleCost::guess_of_entries;
  }
  double copies = 0.0;
  for (std::size_t a = 0; a < 3; ++a) copies += most_copies(what, cuts, a) * cuts.grid[a] / ranks;
  return ParticleCost::of_row * (std::ranges::max(rows) + copies) + std::ranges::max(entries);
}

}  // namespace

std::array<int, 3> rank_grid(int ranks, const ToShareOut& what) {
  std::array<int, 3> best{ranks, 1, 1};
  if (ranks == 1 || what.places.empty()) return best;
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
  double least = std::numeric_limits<double>::infinity();
  for (int x = 1; x <= ranks; ++x) {
    if (ranks % x != 0) continue;
    for (int y = 1; x * y <= ranks; ++y) {
      if (ranks % (x * y) != 0) continue;
      const std::array<int, 3> grid{x, y, ranks / (x * y)};
      const double step = predicted_step(some, cuts_of(some, grid));
      if (step < least) {
        least = step;
        best = grid;
      }
    }
  }
  return best;
}

}  // namespace tripoint
