// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_lists.hpp"

#include <algorithm>
#include <bit>

namespace tripoint::elastic {
namespace {

std::size_t hash_of(const BondShape& s) {
  std::uint64_t h = 0;
  for (const double v : {s.x.x, s.x.y, s.x.z, s.slope, s.hourglass, s.gradient.x, s.gradient.y, s.gradient.z})
    h = (std::rotl(h, 23) ^ std::bit_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
  return h ^ (h >> 29);
}

}  // namespace

void BondLists::clear() {
  shapes_.clear();
  table_.clear();
  followed_ = 0;
}

/// Keeps the table at most half full.
void BondLists::make_room() {
  if (2 * (shapes_.size() + 1) <= table_.size()) return;
  table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), 0);
  for (std::uint32_t n = 0; n < shapes_.size(); ++n) {
    std::size_t at = hash_of(shapes_[n]) & (table_.size() - 1);
    while (table_[at] != 0) at = (at + 1) & (table_.size() - 1);
    table_[at] = n + 1;
  }
}

std::uint32_t BondLists::shape_of(const Bond& bond) {
  const double x2 = dot(bond.x, bond.x);
  const BondShape shape{bond.x, dot(bond.gradient, bond.x) / x2, bond.gradient, bond.weight / x2};
  make_room();
  std::size_t at = hash_of(shape) & (table_.size() - 1);
  for (; table_[at] != 0; at = (at + 1) & (table_.size() - 1))
    if (shapes_[table_[at] - 1] == shape) return table_[at] - 1;
  shapes_.push_back(shape);
  table_[at] = static_cast<std::uint32_t>(shapes_.size());
  return table_[at] - 1;
}

bool BondLists::follow(const Bonds& bonds) {
  if (bonds.changes() == followed_) return false;
  const bool mostly_left = shapes_.size() > 2 * bonds.pairs() + 1024;  // shapes that no bond has any more
  if (bonds.changes() < followed_ || mostly_left) clear();
  other_.resize(bonds.places());
  shape_.resize(bonds.places());
  seen_.resize(bonds.places());
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < bonds.particles(); ++id)
    if (bonds.changed(id) > followed_) ids.push_back(id);
  for (const std::uint32_t id : ids) {
    std::size_t at = bonds.start(id);
    for (const Bond& b : bonds.of(id)) {
      other_[at] = b.other;
      shape_[at] = shape_of(b);
      ++at;
    }
  }
  for (const std::uint32_t id : ids) {
    std::size_t at = bonds.start(id);
    for (const Bond& b : bonds.of(id)) {
      const std::size_t twin = bonds.start(b.other) + b.twin;
      seen_[at] = shape_[twin];
      seen_[twin] = shape_[at];
      ++at;
    }
  }
  followed_ = bonds.changes();
  return true;
}

}  // namespace tripoint::elastic
