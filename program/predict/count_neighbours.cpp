// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "program/predict/shares.hpp"

namespace tripoint::predict {
namespace {

/// Points sorted by cubes of one reach.
class Cells {
 public:
  Cells(const std::vector<Point>& members, const std::vector<Point>& images, double reach) : reach_(reach) {
    low_ = members.front().at;
    Vec3 high = low_;
    for (const auto* list : {&members, &images})
      for (const Point& p : *list)
        for (std::size_t a = 0; a < 3; ++a) {
          low_[a] = std::min(low_[a], p.at[a]);
          high[a] = std::max(high[a], p.at[a]);
        }
    for (std::size_t a = 0; a < 3; ++a) count_[a] = static_cast<long>((high[a] - low_[a]) / reach) + 1;
    start_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (const auto* list : {&members, &images})
      for (const Point& p : *list) ++start_[cell_of(p.at) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    points_.resize(members.size() + images.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const auto* list : {&members, &images})
      for (const Point& p : *list) points_[next[cell_of(p.at)]++] = p;
  }

  /// Points within the reach of p, p itself among them.
  [[nodiscard]] NeighbourCount around(const Point& p) const {
    const auto c = place_of(p.at);
    NeighbourCount found;
    for (long z = std::max(c[2] - 1, 0L); z <= std::min(c[2] + 1, count_[2] - 1); ++z)
      for (long y = std::max(c[1] - 1, 0L); y <= std::min(c[1] + 1, count_[1] - 1); ++y) {
        const long row = (z * count_[1] + y) * count_[0];
        const std::size_t from = start_[static_cast<std::size_t>(row + std::max(c[0] - 1, 0L))],
                          to = start_[static_cast<std::size_t>(row + std::min(c[0] + 1, count_[0] - 1)) + 1];
        for (std::size_t n = from; n < to; ++n) {
          const Vec3 d = points_[n].at - p.at;
          if (!(d.x * d.x + d.y * d.y + d.z * d.z < reach_ * reach_)) continue;
          found.all += 1.0;
          found.worked += p.idle && points_[n].idle ? 0.0 : 1.0;
        }
      }
    return found;
  }

 private:
  [[nodiscard]] std::array<long, 3> place_of(const Vec3& r) const {
    std::array<long, 3> c{};
    for (std::size_t a = 0; a < 3; ++a)
      c[a] = std::min(static_cast<long>((r[a] - low_[a]) / reach_), count_[a] - 1);
    return c;
  }
  [[nodiscard]] std::size_t cell_of(const Vec3& r) const {
    const auto c = place_of(r);
    return static_cast<std::size_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0]);
  }

  double reach_;
  Vec3 low_;
  std::array<long, 3> count_{};
  std::vector<std::size_t> start_;
  std::vector<Point> points_;
};

}  // namespace

std::vector<NeighbourCount> count_neighbours(const std::vector<Point>& members,
                                             const std::vector<Point>& images, double reach) {
  std::vector<NeighbourCount> found;
  if (members.empty()) return found;
  const Cells cells(members, images, reach);
  found.reserve(members.size());
  for (const Point& p : members) {
    found.push_back(cells.around(p));
    found.back().all -= 1.0;
    found.back().worked -= p.idle ? 0.0 : 1.0;
  }
  return found;
}

}  // namespace tripoint::predict
