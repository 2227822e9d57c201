// SPDX-License-Identifier: BSD-3-Clause
#include "step/sharing.hpp"

#include <string>

namespace tripoint {

/// Where there are no neighbour lists, as if there were.
bool Sharing::outdated(const World& world) const {
  const Particles& p = world.particles;
  if (world.neighbours) return world.neighbours->outdated(p);
  if (shared_at_.size() != p.size()) return true;
  const double limit = 0.5 * skin_ * world.support();
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(norm(x.at(i) - shared_at_[i]) <= limit)) return true;
  return false;
}

void Sharing::follow(World& world, const std::vector<Active>& effects) {
  double any = outdated(world) ? -1.0 : 0.0;
  std::string unused;
  world.halo->take_least(any, unused);
  if (any == 0.0) return;
  world.halo->migrate(world.particles, world.bonds, world.own, world.box);
  for (const Active& a : effects) a.effect->renumber(world);
  if (world.neighbours) return world.neighbours->forget();
  mark_copies(world);
  const auto x = positions(world.particles);
  shared_at_.clear();
  for (std::size_t i = 0; i < world.particles.size(); ++i) shared_at_.push_back(x.at(i));
}

void mark_copies(World& world) {
  const auto id = world.particles[field::id];
  world.copies.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) world.copies[i] = static_cast<std::size_t>(id[i]) >= world.halo->owned();
}

}  // namespace tripoint
