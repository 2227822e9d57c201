// SPDX-License-Identifier: BSD-3-Clause
#include "step/sharing.hpp"

#include <algorithm>
#include <string>

namespace tripoint {
namespace {

bool splits(const Halo& halo) {
  const std::array<bool, 3> split = halo.splits();
  return std::ranges::find(split, true) != split.end();
}

/// Heat that was given to each body [J]; empty where nobody counts it.
std::span<double> body_heat(World& world) {
  return world.bodies.has(field::body_heat) ? world.bodies[field::body_heat] : std::span<double>{};
}

/// What a process sees to be periodic by itself.
PeriodicBox seen_box(const World& world) {
  PeriodicBox box = world.box;
  for (std::size_t a = 0; a < 3; ++a) box.periodic[a] = box.periodic[a] && !world.halo->splits()[a];
  return box;
}

}  // namespace

bool Sharing::is_part(const World& world) const { return world.halo && splits(*world.halo); }

bool Sharing::any(bool here) const {
  double least = here ? -1.0 : 0.0;
  std::string unused;
  halo_->take_least(least, unused);
  return least < 0.0;
}

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

void Sharing::gather(World& world, const std::vector<Active>& effects) {
  if (!is_part(world)) return;
  const auto heat = body_heat(world);
  booked_ = {world.booked, {heat.begin(), heat.end()}};
  hold_whole(world);
  for (const Active& a : effects) a.effect->renumber(world);
}

void Sharing::hold_whole(World& world) const {
  WholeScene whole = world.halo->gather(world.particles, world.bonds, world.own);
  world.particles = std::move(whole.particles);
  world.bonds = std::move(whole.bonds);
  world.own = std::move(whole.own);
  world.halo = nullptr;
  world.copies.clear();
  if (!world.neighbours) return;
  world.neighbours = world.neighbours->anew(world.box);
  world.neighbours->update(world.particles, world.time);
  world.neighbours->mark_own(world.particles, world.own);
}

World Sharing::whole(const World& part) const {
  World world = part;
  hold_whole(world);
  halo_->add(world.booked.values());
  halo_->add(body_heat(world));
  std::string unused;
  halo_->take_least(world.lagged.viscous_step, unused);
  return world;
}

void Sharing::share_out(World& world) {
  world.halo = halo_;
  if (!halo_->is_first()) {
    std::vector<double> heat = booked_ ? booked_->body_heat : std::vector<double>{};
    heat.resize(body_heat(world).size());
    std::ranges::copy(heat, body_heat(world).begin());
    if (booked_)
      world.booked = booked_->accounts;
    else
      world.booked.clear();
  }
  booked_.reset();
  halo_->share_out(world.particles, world.bonds, world.own, world.box);
  if (world.neighbours) world.neighbours = world.neighbours->anew(seen_box(world));
}

void Sharing::follow(World& world, const std::vector<Active>& effects) {
  if (!world.halo) {
    share_out(world);
  } else {
    if (!any(outdated(world))) return;
    world.halo->migrate(world.particles, world.bonds, world.own, world.box);
    if (world.neighbours) world.neighbours->forget();
  }
  for (const Active& a : effects) a.effect->renumber(world);
  mark_copies(world);
  if (world.neighbours) return;
  const auto x = positions(world.particles);
  shared_at_.clear();
  for (std::size_t i = 0; i < world.particles.size(); ++i) shared_at_.push_back(x.at(i));
}

void mark_copies(World& world) {
  world.copies.clear();
  if (!splits(*world.halo)) return;
  const auto id = world.particles[field::id];
  world.copies.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) world.copies[i] = static_cast<std::size_t>(id[i]) >= world.halo->owned();
}

}  // namespace tripoint
