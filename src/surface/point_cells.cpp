// SPDX-License-Identifier: BSD-3-Clause
#include "surface/point_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/errors.hpp"

namespace tripoint {
namespace {

constexpr std::size_t vector_width = 4;
constexpr double far_away = 1e30;  // [m], beyond every reach; its square is finite

/// Distance from a place to an interval [m].
double outside(double r, double low, double high) { return std::max({low - r, r - high, 0.0}); }

}  // namespace

Box box_around(std::span<const Vec3> points) noexcept {
  constexpr double most = std::numeric_limits<double>::max();
  Box b{{most, most, most}, {-most, -most, -most}};
  for (const Vec3& r : points)
    for (std::size_t a = 0; a < 3; ++a) {
      b.low[a] = std::min(b.low[a], r[a]);
      b.high[a] = std::max(b.high[a], r[a]);
    }
  return b;
}

PointCells::PointCells(std::span<const Vec3> points, double side)
    : side_(side), box_(box_around(points)), table_(points.size()) {
  if (!std::ranges::all_of(points, [](const Vec3& r) { return finite(r); }))
    throw InputError("a surface is asked of a particle whose place is not finite");
  origin_ = points.empty() ? Vec3{} : box_.low;
  for (std::size_t a = 0; a < 3; ++a)
    if (!points.empty() && !((box_.high[a] - box_.low[a]) / side < CellTable::most - 8))
      throw InputError("particles lie too far apart for a surface: leave out those that have flown away");
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    order[i] = {CellTable::key(cell_of(points[i])), static_cast<std::uint32_t>(i)};
  std::ranges::sort(order);
  for (const auto& [key, row] : order) {
    if (keys_.empty() || keys_.back() != key) {
      table_.insert(key, static_cast<std::uint32_t>(keys_.size()));
      keys_.push_back(key);
      first_.push_back(static_cast<std::uint32_t>(row_.size()));
    }
    x_.push_back(points[row].x);
    y_.push_back(points[row].y);
    z_.push_back(points[row].z);
    row_.push_back(row);
  }
  first_.push_back(static_cast<std::uint32_t>(row_.size()));
}

CellIndex PointCells::cell_of(const Vec3& r) const noexcept {
  const auto along = [&](std::size_t a) {
    return static_cast<std::int32_t>(std::floor(std::clamp((r[a] - origin_[a]) / side_, -1e6, 1e6)));
  };
  return {along(0), along(1), along(2)};
}

Box PointCells::box_of(const CellIndex& c) const noexcept {
  const Vec3 low =
      origin_ + side_ * Vec3{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  return {low, low + Vec3{side_, side_, side_}};
}

void PointCells::gather(const CellIndex& c, double reach, NearPoints& out) const {
  out.x.clear();
  out.y.clear();
  out.z.clear();
  out.row.clear();
  const int rings = static_cast<int>(std::ceil(reach / side_));
  const Box b = box_of(c);
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j)
      for (int k = -rings; k <= rings; ++k) {
        const std::uint32_t cell = table_.find(CellTable::key({c[0] + i, c[1] + j, c[2] + k}));
        if (cell == CellTable::none) continue;
        for (std::uint32_t n = first_[cell]; n < first_[cell + 1]; ++n) {
          const double dx = outside(x_[n], b.low.x, b.high.x), dy = outside(y_[n], b.low.y, b.high.y),
                       dz = outside(z_[n], b.low.z, b.high.z);
          if (dx * dx + dy * dy + dz * dz >= reach * reach) continue;
          out.x.push_back(x_[n]);
          out.y.push_back(y_[n]);
          out.z.push_back(z_[n]);
          out.row.push_back(row_[n]);
        }
      }
  while (out.x.size() % vector_width != 0) {
    out.x.push_back(far_away);
    out.y.push_back(far_away);
    out.z.push_back(far_away);
  }
}

const NearPoints& NearCache::around(const Vec3& r) {
  const CellIndex c = cells_->cell_of(r);
  Entry& entry = entries_[static_cast<std::size_t>(CellTable::key(c) * 0x9e3779b97f4a7c15ULL >> 54) % slots];
  if (!entry.filled || entry.cell != c) {
    cells_->gather(c, reach_, entry.points);
    entry.cell = c;
    entry.filled = true;
  }
  return entry.points;
}

}  // namespace tripoint
