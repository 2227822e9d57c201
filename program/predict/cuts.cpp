// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "particles/rank_grid.hpp"
#include "program/predict/shares.hpp"

namespace tripoint::predict {
namespace {

constexpr double allowed = 1.02;  ///< greatest number of a rank over the mean, as the engine asks of `balance`
constexpr int most_rounds = 20;   ///< likewise
constexpr double margin =
    1e-4;  ///< by which LAMMPS keeps a shrunk box around its particles, in widths of the box that it was made with

double cost_of(const Cloud& cloud, std::size_t i) { return ParticleCost::at_start(cloud.is_idle(i)); }

/// Greatest cost of a part over the mean.
double imbalance(const Cloud& cloud, const Cuts& cuts) {
  std::vector<double> costs(static_cast<std::size_t>(cuts.grid[0]) * cuts.grid[1] * cuts.grid[2]);
  double sum = 0.0;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    const Vec3& r = cloud.position[i];
    std::size_t place = 0, stride = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& at = cuts.at[a];
      const auto n = std::upper_bound(at.begin() + 1, at.end() - 1, r[a]) - at.begin() - 1;
      place += stride * static_cast<std::size_t>(n);
      stride *= static_cast<std::size_t>(cuts.grid[a]);
    }
    costs[place] += cost_of(cloud, i);
    sum += cost_of(cloud, i);
  }
  return *std::max_element(costs.begin(), costs.end()) * static_cast<double>(costs.size()) / sum;
}

/// Places of one direction, ascending, and the cost of all before each; one number more, of all.
struct CostAlong {
  std::vector<double> place, before;
};

CostAlong cost_along(const Cloud& cloud, std::size_t a) {
  std::vector<std::pair<double, double>> sorted;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) sorted.emplace_back(cloud.position[i][a], cost_of(cloud, i));
  std::sort(sorted.begin(), sorted.end());
  CostAlong along{{}, {0.0}};
  for (const auto& [place, cost] : sorted) {
    along.place.push_back(place);
    along.before.push_back(along.before.back() + cost);
  }
  return along;
}

/// Planes of one direction, each bisected between the nearest places known to have too little and too much below, until all costs
/// are within `delta`.
void shift(const CostAlong& cost, std::vector<double>& at, double delta) {
  const std::size_t n = at.size() - 1;
  const auto below = [&](double place) {
    return cost
        .before[static_cast<std::size_t>(std::lower_bound(cost.place.begin(), cost.place.end(), place) - cost.place.begin())];
  };
  std::vector<double> low(n + 1, at.front()), high(n + 1, at.back());
  for (int round = 0; round < most_rounds; ++round) {
    bool close = true;
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = 1; j < n; ++j) {
        const double target = cost.before.back() * static_cast<double>(i) / static_cast<double>(n), sum = below(at[j]);
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

Cuts cuts_of(const Cloud& cloud, int ranks) {
  if (cloud.position.empty()) throw InputError("there is no particle to share out");
  Vec3 low = cloud.position.front(), high = low;
  for (const Vec3& r : cloud.position)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], r[a]);
      high[a] = std::max(high[a], r[a]);
    }
  const Vec3 around{cloud.spacing, cloud.spacing, cloud.spacing};
  Cuts cuts;
  cuts.grid = rank_grid(ranks, high - low + around, cloud.periodic);
  for (std::size_t a = 0; a < 3; ++a) {
    const bool wraps = cloud.periodic[a] && cuts.cut(a);
    const double room = margin * (high[a] - low[a] + 2.0 * cloud.spacing);  // the engine makes it one spacing wider on each side
    const double from = wraps ? cloud.min[a] : low[a] - room, to = wraps ? cloud.max[a] : high[a] + room;
    for (int n = 0; n <= cuts.grid[a]; ++n) cuts.at[a].push_back(from + (to - from) * n / cuts.grid[a]);
  }
  const double delta = std::cbrt(allowed) - 1.0;
  for (std::size_t a = 0; a < 3 && imbalance(cloud, cuts) > allowed; ++a) {
    if (!cuts.cut(a)) continue;
    shift(cost_along(cloud, a), cuts.at[a], delta);
  }
  return cuts;
}

double messages_of(const Cuts& cuts, double reach) {
  double messages = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!cuts.cut(a)) continue;
    double thinnest = cuts.at[a].back() - cuts.at[a].front();
    for (std::size_t n = 1; n < cuts.at[a].size(); ++n) thinnest = std::min(thinnest, cuts.at[a][n] - cuts.at[a][n - 1]);
    const double hops = thinnest > 0.0 ? std::ceil(reach / thinnest) : 1.0;
    messages += 2.0 * std::clamp(hops, 1.0, static_cast<double>(cuts.grid[a]));
  }
  return messages;
}

}  // namespace tripoint::predict
