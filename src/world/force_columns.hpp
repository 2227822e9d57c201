// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "world/world.hpp"

namespace tripoint {

/// The columns of each of World::forces [N], in their order. Valid until particles are sorted anew.
[[nodiscard]] inline std::vector<Triple<const double>> force_columns(const World& world) {
  std::vector<Triple<const double>> list;
  for (const Force& f : world.forces) list.push_back(triple(world.particles, f.x, f.y, f.z));
  return list;
}

/// Sum of the forces on one particle [N].
[[nodiscard]] inline Vec3 total_force(const std::vector<Triple<const double>>& forces, std::size_t row) {
  Vec3 sum;
  for (const auto& f : forces) sum += f.at(row);
  return sum;
}

}  // namespace tripoint
