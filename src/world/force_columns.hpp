// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "world/world.hpp"

namespace tripoint {

/// The columns of each of World::forces [N], in their order. Valid until particles are sorted anew.
[[nodiscard]] inline std::vector<Triple<const double>> force_columns(const World& world) {
  std::vector<Triple<const double>> list;
  for (const Force& f : world.forces) list.push_back(triple(world.particles, f.x, f.y, f.z));
  return list;
}

/// The same where their number is known as the program is compiled: a loop over particles then has no loop over forces in it.
template <std::size_t n>
using ForceColumns = std::array<Triple<const double>, n>;

/// Calls visit(ForceColumns<n>) for the number n of forces that the scene has. @return what it returns
template <std::size_t n = 0, class Visit>
auto with_force_columns(const World& world, const Visit& visit) {
  if constexpr (n < most_forces)
    if (world.forces.size() > n) return with_force_columns<n + 1>(world, visit);
  ForceColumns<n> columns;
  for (std::size_t k = 0; k < n; ++k) {
    const Force& f = world.forces[k];
    columns[k] = triple(world.particles, f.x, f.y, f.z);
  }
  return visit(columns);
}

/// Sum of the forces on one particle [N]. @param forces columns of the one kind or of the other
template <class Forces>
[[nodiscard, gnu::always_inline]] inline Vec3 total_force(const Forces& forces, std::size_t row) {
  Vec3 sum;
  for (const auto& f : forces) sum += f.at(row);
  return sum;
}

}  // namespace tripoint
