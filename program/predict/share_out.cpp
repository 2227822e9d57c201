// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "program/predict/images.hpp"
#include "program/predict/shares.hpp"

namespace tripoint::predict {
namespace {

/// Places at which rank n of a direction sees a particle: in its own part (first), and as copies.
struct Seen {
  bool own = false;
  std::vector<double> copies;
};

/// @param wraps whether the direction is cut and periodic, of this width [m]
Seen seen_by(const std::vector<double>& at, std::size_t n, double x, double reach, double width) {
  const double low = at[n], high = at[n + 1];
  Seen s;
  const bool first = n == 0, last = n + 2 == at.size();
  s.own = (x >= low || (first && width == 0.0)) && (x < high || (last && width == 0.0));
  const int most = width > 0.0 ? static_cast<int>(std::ceil(reach / width)) + 1 : 0;
  for (int image = -most; image <= most; ++image) {
    const double place = x + image * width;
    if (image == 0 && s.own) continue;
    if (place >= low - reach && place <= high + reach) s.copies.push_back(place);
  }
  return s;
}

/// By direction and part: where its ranks see the particle at r; in the part that has it as its own, its
/// place comes first.
using SeenBy = std::array<std::vector<Seen>, 3>;
SeenBy seen_by_all(const Cloud& cloud, const Cuts& cuts, Vec3 r) {
  SeenBy seen;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool wraps = cloud.periodic[a] && cuts.cut(a);
    const double width = wraps ? cloud.max[a] - cloud.min[a] : 0.0;
    if (wraps) r[a] -= std::floor((r[a] - cloud.min[a]) / width) * width;
    for (std::size_t n = 0; n < static_cast<std::size_t>(cuts.grid[a]); ++n) {
      Seen s = cuts.cut(a) ? seen_by(cuts.at[a], n, r[a], cloud.reach, width) : Seen{true, {}};
      if (s.own) s.copies.insert(s.copies.begin(), r[a]);
      seen[a].push_back(std::move(s));
    }
  }
  return seen;
}

/// Particles of a rank: its own and copies.
struct Held {
  std::vector<Point> points;
  std::vector<char> own;  ///< of each
};

/// Adds a particle to the rank that sees it so in each direction: as its own, and as copies.
void hold(const Seen& x, const Seen& y, const Seen& z, bool idle, Held& held, Share& share) {
  const bool own = x.own && y.own && z.own;
  const std::size_t first = held.points.size();
  for (const double at_z : z.copies)
    for (const double at_y : y.copies)
      for (const double at_x : x.copies) held.points.push_back({{at_x, at_y, at_z}, idle});
  held.own.resize(held.points.size(), 0);
  if (own) held.own[first] = 1;  // its own place comes first
  const double all = static_cast<double>(x.copies.size() * y.copies.size() * z.copies.size());
  share.own += own ? 1.0 : 0.0;
  share.copies += own ? all - 1.0 : all;
}

}  // namespace

std::vector<Point> points_of(const Cloud& cloud) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    points.push_back({cloud.position[i], cloud.is_idle(i)});
  return points;
}

std::vector<Point> images_within(const std::vector<Point>& members, const std::array<bool, 3>& seen,
                                 const Vec3& min, const Vec3& max, double reach) {
  std::vector<Point> all = members;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!seen[a]) continue;
    const double width = max[a] - min[a];
    const int most = static_cast<int>(std::ceil(reach / width));
    const std::size_t count = all.size();
    for (std::size_t i = 0; i < count; ++i)
      for (int image = -most; image <= most; ++image) {
        if (image == 0) continue;
        Point p = all[i];
        p.at[a] += image * width;
        if (p.at[a] >= min[a] - reach && p.at[a] <= max[a] + reach) all.push_back(p);
      }
  }
  return {all.begin() + static_cast<std::ptrdiff_t>(members.size()), all.end()};
}

Shares share_out(const Cloud& cloud, int ranks) {
  const Cuts cuts = cuts_of(cloud, ranks);
  Shares shares;
  shares.grid = cuts.grid;
  shares.messages = messages_of(cuts, cloud.reach);
  std::vector<Held> held(static_cast<std::size_t>(ranks));
  shares.ranks.resize(held.size());
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    const SeenBy seen = seen_by_all(cloud, cuts, cloud.position[i]);
    std::size_t rank = 0;
    for (const Seen& z : seen[2])
      for (const Seen& y : seen[1])
        for (const Seen& x : seen[0]) {
          hold(x, y, z, cloud.is_idle(i), held[rank], shares.ranks[rank]);
          ++rank;
        }
  }
  std::array<bool, 3> own_images{};
  for (std::size_t a = 0; a < 3; ++a) own_images[a] = cloud.periodic[a] && !cuts.cut(a);
  for (std::size_t n = 0; n < held.size(); ++n) {
    const std::vector<Point>& points = held[n].points;
    const std::vector<NeighbourCount> neighbours = count_neighbours(
        points, images_within(points, own_images, cloud.min, cloud.max, cloud.pair_reach), cloud.pair_reach);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!held[n].own[i]) continue;
      shares.ranks[n].pairs += neighbours[i].all;
      shares.ranks[n].worked += neighbours[i].worked;
    }
  }
  return shares;
}

}  // namespace tripoint::predict
