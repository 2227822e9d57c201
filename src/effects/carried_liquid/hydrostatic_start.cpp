// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/hydrostatic_start.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tripoint::carried_liquid {
namespace {

constexpr double gap = 1.6;  ///< beyond it two particles of a column do not stand on each other [spacings]

Vec3 pressing(const Scene& scene) {
  Vec3 g = scene.gravity;
  for (std::size_t a = 0; a < 3; ++a)
    if (scene.periodic[a]) g[a] = 0.0;
  return g;
}

struct Column {
  std::vector<std::pair<double, std::size_t>> by_depth;  ///< depth along gravity, and row
};

std::map<std::pair<long, long>, Column> columns_of(const World& world, const Vec3& down) {
  const Vec3 other = std::abs(down.x) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 a = (1.0 / norm(cross(down, other))) * cross(down, other), b = cross(down, a);
  const Vec3 origin = world.particles.position(0);
  std::map<std::pair<long, long>, Column> columns;
  for (std::size_t i = 0; i < world.particles.size(); ++i) {
    const Vec3 r = world.particles.position(i) - origin;
    const auto bin = [&](const Vec3& e) { return std::lround(dot(r, e) / world.scene.spacing); };
    columns[{bin(a), bin(b)}].by_depth.emplace_back(dot(r, down), i);
  }
  for (auto& [at, column] : columns) std::ranges::sort(column.by_depth);
  return columns;
}

}  // namespace

std::vector<double> hydrostatic_start(const World& world) {
  std::vector<double> pressure(world.particles.size(), 0.0);
  const Vec3 g = pressing(world.scene);
  if (g == Vec3{} || world.particles.size() == 0) return pressure;
  const double pull = norm(g), dx = world.scene.spacing;
  const auto group = world.particles[field::group];
  const auto is_wall = [&](std::size_t i) { return group[i] == wall_group; };
  for (const auto& [at, column] : columns_of(world, (1.0 / pull) * g)) {
    const auto& list = column.by_depth;
    for (std::size_t from = 0, past = 0; from < list.size(); from = past) {
      past = from + 1;
      while (past < list.size() && !is_wall(list[past - 1].second) && list[past].first - list[past - 1].first < gap * dx) ++past;
      if (!is_wall(list[past - 1].second)) continue;
      double p = 0.0;
      for (std::size_t n = from; n + 1 < past; ++n) {
        const double rho = world.material_of(list[n].second).density;
        const double before = n == from ? rho * dx : 0.0;
        const double above = n == from ? 0.0 : list[n].first - list[n - 1].first;
        const double rho_above = n == from ? 0.0 : world.material_of(list[n - 1].second).density;
        p += 0.5 * pull * (before + (rho + rho_above) * above);
        pressure[list[n].second] = p;
      }
    }
  }
  return pressure;
}

}  // namespace tripoint::carried_liquid
