// SPDX-License-Identifier: BSD-3-Clause
// The cuts of LAMMPS's `balance ... shift`, worked out without it.
#include <algorithm>
#include <cmath>

#include "particles/rank_grid.hpp"

namespace tripoint {
namespace {

/// By which LAMMPS keeps a shrunk box around its particles, in widths of the box that it was made with
constexpr double margin = 1e-4;

double cost_of(const ToShareOut& what, std::size_t i) { return ParticleCost::at_start(what.is_idle(i)); }

/// Greatest cost of a part over the mean.
double imbalance(const ToShareOut& what, const Cuts& cuts) {
  std::vector<double> costs(static_cast<std::size_t>(cuts.grid[0]) * cuts.grid[1] * cuts.grid[2]);
  double sum = 0.0;
  for (std::size_t i = 0; i < what.places.size(); ++i) {
    costs[cuts.rank_of(what.places[i])] += cost_of(what, i);
    sum += cost_of(what, i);
  }
  return *std::max_element(costs.begin(), costs.end()) * static_cast<double>(costs.size()) / sum;
}

/// Places of one direction, ascending, and the cost of all before each; one number more, of all.
struct CostAlong {
  std::vector<double> place, before;
};

CostAlong cost_along(const ToShareOut& what, std::size_t a) {
  std::vector<std::pair<double, double>> sorted;
  for (std::size_t i = 0; i < what.places.size(); ++i)
    sorted.emplace_back(what.places[i][a], cost_of(what, i));
  std::sort(sorted.begin(), sorted.end());
  CostAlong along{{}, {0.0}};
  for (const auto& [place, cost] : sorted) {
    along.place.push_back(place);
    along.before.push_back(along.before.back() + cost);
  }
  return along;
}

/// Planes of one direction, each bisected between the nearest places known to have too little and too much
/// below, until all costs are within `delta`.
void shift(const CostAlong& cost, std::vector<double>& at, double delta) {
  const std::size_t n = at.size() - 1;
  const auto below = [&](double place) {
    return cost.before[static_cast<std::size_t>(
        std::lower_bound(cost.place.begin(), cost.place.end(), place) - cost.place.begin())];
  };
  std::vector<double> low(n + 1, at.front()), high(n + 1, at.back());
  for (int round = 0; round < most_bisections; ++round) {
    bool close = true;
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = 1; j < n; ++j) {
        const double target = cost.before.back() * static_cast<double>(i) / static_cast<double>(n),
                     sum = below(at[j]);
        if (sum <= target) low[i] = std::max(low[i], at[j]);
        if (sum >= target) high[i] = std::min(high[i], at[j]);
        if (i == j && std::abs(sum - target) > delta * target) close = false;
      }
    }
    if (close) return;
    for (std::size_t i = 1; i < n; ++i) at[i] = 0.5 * (low[i] + high[i]);
  }
}

}  // namespace

std::size_t Cuts::rank_of(const Vec3& r) const {
  std::size_t rank = 0, stride = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto n = std::upper_bound(at[a].begin() + 1, at[a].end() - 1, r[a]) - at[a].begin() - 1;
    rank += stride * static_cast<std::size_t>(n);
    stride *= static_cast<std::size_t>(grid[a]);
  }
  return rank;
}

Cuts cuts_of(const ToShareOut& what, const std::array<int, 3>& grid) {
  Vec3 low = what.places.front(), high = low;
  for (const Vec3& r : what.places)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], r[a]);
      high[a] = std::max(high[a], r[a]);
    }
  Cuts cuts;
  cuts.grid = grid;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool wraps = what.periodic[a] && cuts.cut(a);
    // The engine makes it one spacing wider on each side
    const double room = margin * (high[a] - low[a] + 2.0 * what.spacing);
    const double from = wraps ? what.min[a] : low[a] - room, to = wraps ? what.max[a] : high[a] + room;
    for (int n = 0; n <= grid[a]; ++n) cuts.at[a].push_back(from + (to - from) * n / grid[a]);
  }
  const double delta = std::cbrt(allowed_at_start) - 1.0;
  for (std::size_t a = 0; a < 3 && imbalance(what, cuts) > allowed_at_start; ++a) {
    if (!cuts.cut(a)) continue;
    shift(cost_along(what, a), cuts.at[a], delta);
  }
  return cuts;
}

}  // namespace tripoint
