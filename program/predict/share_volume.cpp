// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "program/predict/images.hpp"
#include "program/predict/shares.hpp"

namespace tripoint::predict {
namespace {

/// How much of a cube one rank of a direction has, and sees beyond its part.
struct Part {
  std::size_t rank = 0;
  double own = 0.0, beyond = 0.0;  ///< shares of the cube's width
};

constexpr std::size_t points_enough = 200'000;  ///< to find cuts by

/// The matter of a cloud as points that lie evenly within the cube of each particle. Of a finer scene layers
/// are thin beside the parts of ranks, so that cuts are not held between the layers of the cloud.
Cloud spread(const Cloud& cloud) {
  // g^4 = g + 1: the sequence of [Roberts 2018] in three dimensions
  constexpr double g = 1.22074408460575947536;
  const std::size_t each = points_enough / cloud.position.size() + 1;
  Cloud points = cloud;
  points.position.clear();
  points.idle.clear();
  std::size_t k = 0;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    for (std::size_t n = 0; n < each; ++n) {
      ++k;
      Vec3 r = cloud.position[i];
      double step = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
        step /= g;
        const double at = 0.5 + step * static_cast<double>(k);
        r[a] += cloud.spacing * (at - std::floor(at) - 0.5);
      }
      points.position.push_back(r);
      points.idle.push_back(cloud.is_idle(i) ? 1 : 0);
    }
  return points;
}

double overlap(double a, double b, double low, double high) {
  return std::max(0.0, std::min(b, high) - std::max(a, low));
}

/// Lists the shares of the cube from a to b in each part whose widened interval it touches. The outer parts
/// of a direction that does not wrap have no outer end.
void parts_of(const std::vector<double>& at, double a, double b, double reach, double width,
              std::vector<Part>& parts) {
  parts.clear();
  const std::size_t n = at.size() - 1;
  const int most = width > 0.0 ? static_cast<int>(std::ceil(reach / width)) + 1 : 0;
  for (int image = -most; image <= most; ++image) {
    const double from = a + image * width, to = b + image * width;
    auto k = static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(0, std::upper_bound(at.begin(), at.end(), from - reach) - at.begin() - 1));
    for (; k < n && at[k] - reach < to; ++k) {
      const double low = width == 0.0 && k == 0 ? -INFINITY : at[k],
                   high = width == 0.0 && k + 1 == n ? INFINITY : at[k + 1];
      const double own = overlap(from, to, low, high), all = overlap(from, to, low - reach, high + reach);
      if (!(all > 0.0)) continue;
      const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.rank == k; });
      Part& p = found == parts.end() ? parts.emplace_back(Part{k, 0.0, 0.0}) : *found;
      p.own += own / (b - a);
      p.beyond += (all - own) / (b - a);
    }
  }
}

}  // namespace

Shares share_volume(const Cloud& cloud, int ranks, double particles) {
  const Cuts cuts = cuts_of(spread(cloud), ranks);
  const double each = particles / static_cast<double>(cloud.position.size()), finer = std::cbrt(1.0 / each),
               reach = cloud.reach * finer;
  Shares shares;
  shares.grid = cuts.grid;
  shares.messages = messages_of(cuts, reach);
  shares.ranks.resize(static_cast<std::size_t>(ranks));
  const std::vector<Point> points = points_of(cloud);
  const std::vector<NeighbourCount> neighbours =
      count_neighbours(points, images_within(points, cloud.periodic, cloud.min, cloud.max, cloud.pair_reach),
                       cloud.pair_reach);
  std::array<std::vector<Part>, 3> parts;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      const bool wraps = cloud.periodic[a] && cuts.cut(a);
      const double x = cloud.position[i][a], half = 0.5 * cloud.spacing;
      if (cuts.cut(a))
        parts_of(cuts.at[a], x - half, x + half, reach, wraps ? cloud.max[a] - cloud.min[a] : 0.0, parts[a]);
      else
        parts[a].assign(1, Part{0, 1.0, 0.0});
    }
    for (const Part& z : parts[2])
      for (const Part& y : parts[1])
        for (const Part& x : parts[0]) {
          Share& s = shares.ranks[x.rank + static_cast<std::size_t>(cuts.grid[0]) *
                                               (y.rank + static_cast<std::size_t>(cuts.grid[1]) * z.rank)];
          const double own = x.own * y.own * z.own,
                       all = (x.own + x.beyond) * (y.own + y.beyond) * (z.own + z.beyond);
          s.own += each * own;
          s.copies += each * (all - own);
          s.worked += each * neighbours[i].worked * own;
          s.pairs += each * neighbours[i].all * own;
        }
  }
  return shares;
}

}  // namespace tripoint::predict
