// SPDX-License-Identifier: BSD-3-Clause
#include "effects/motion/motion.hpp"

#include <algorithm>
#include <cmath>

#include "scene/ledger_entry.hpp"
#include "scene/shared_terms.hpp"
#include "world/body_table.hpp"
#include "world/force_columns.hpp"
#include "world/ordered_sum.hpp"

namespace tripoint::motion {
namespace {

enum Work : std::size_t { by_gravity = most_forces, works_on_driven, works = works_on_driven + most_forces };

/// Moves the velocity of one particle on and adds up the works on it. All that it reads is its own, so that a loop over particles
/// keeps it in registers.
template <std::size_t n>
struct Kick {
  ForceColumns<n> forces;
  Triple<double> v;
  std::span<const double> m;
  RigidMembers is_member;
  std::span<const int> driven;  ///< empty: nobody guides a particle
  Vec3 g;
  double dt;

  [[gnu::always_inline]] void operator()(std::size_t i, std::array<double, works>& work) const {
    if (is_member(i)) return;
    if (!driven.empty() && driven[i] != 0) {  // its driver takes the work
      for (std::size_t k = 0; k < n; ++k) work[works_on_driven + k] += dt * dot(forces[k].at(i), v.at(i));
      return;
    }
    const Vec3 before = v.at(i), after = before + (dt / m[i]) * total_force(forces, i) + dt * g;
    const Vec3 way = (0.5 * dt) * (before + after);
    for (std::size_t k = 0; k < n; ++k) work[k] += dot(forces[k].at(i), way);
    work[by_gravity] += m[i] * dot(g, way);
    v.set(i, after);
  }
};

class FreeMotion : public Effect {
 public:
  void kick(World&, double dt) override;
  void drift(World&, double dt) override;
  [[nodiscard]] TimeStepBound max_dt(const World&) const override;
  void add_to(const World&, Ledger&) const override;

 private:
  std::vector<std::array<double, works>> blocks_;  ///< memory that is used again
};

/// v += dt (sum F/m + g). The work of each force is booked by its own formula, dt F.(v- + v+)/2. The sum of these works is the
/// change of kinetic energy to round-off (model 8.11).
void FreeMotion::kick(World& world, double dt) {
  Particles& p = world.particles;
  const auto driven = p.has(field::driven.name) ? std::as_const(p)[field::driven] : std::span<const int>{};
  const auto sums = with_force_columns(world, [&]<std::size_t n>(const ForceColumns<n>& forces) {
    const Kick<n> kick{forces, velocities(p), p[field::mass], RigidMembers(world), driven, world.scene.gravity, dt};
    return ordered_sums(world, blocks_, kick);
  });
  for (std::size_t k = 0; k < world.forces.size(); ++k) {
    world.booked[world.forces[k].work] += sums[k];
    world.booked[work_on_driven(world.forces[k])] += sums[works_on_driven + k];
  }
  world.booked[account::gravity_work] += sums[by_gravity];
}

/// r += dt v; with the transport velocity of the scene's choice, dt (v + shift).
void FreeMotion::drift(World& world, double dt) {
  Particles& p = world.particles;
  const auto r = positions(p), v = velocities(p);
  const bool shifts = p.has(field::shift_x.name);
  const auto w = shifts ? triple(std::as_const(p), field::shift_x, field::shift_y, field::shift_z) : Triple<const double>{};
  const RigidMembers is_member(world);
  const bool guided = p.has(field::driven.name);
  const auto driven = guided ? std::as_const(p)[field::driven] : std::span<const int>{};
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t i = 0; i < p.moving(); ++i)
    if (!is_member(i) && !(guided && driven[i] != 0)) r.set(i, r.at(i) + dt * (shifts ? v.at(i) + w.at(i) : v.at(i)));
  world.moved = true;
}

/// 0.25 sqrt(h/|a|max) (model 8.10).
TimeStepBound FreeMotion::max_dt(const World& world) const {
  const Particles& p = world.particles;
  const std::vector<Triple<const double>> forces = force_columns(world);
  const auto m = p[field::mass];
  const Vec3 g = world.scene.gravity;
  const RigidMembers is_member(world);
  double a2 = 0.0;
#pragma omp parallel for schedule(static) num_threads(world.threads) reduction(max : a2)
  for (std::size_t i = 0; i < p.moving(); ++i) {
    if (is_member(i)) continue;
    const Vec3 a = g + total_force(forces, i) / m[i];
    a2 = std::max(a2, dot(a, a));
  }
  TimeStepBound bound;
  if (a2 > 0.0) tighten(bound, acceleration_step(world.support(), std::sqrt(a2)), "acceleration");
  return bound;
}

void FreeMotion::add_to(const World& world, Ledger& ledger) const {
  enum Entry : std::size_t { momentum, angular = 3, kinetic = 6, potential, entries };
  const Particles& p = world.particles;
  const auto m = p[field::mass];
  const auto v = velocities(p);
  const RigidMembers is_member(world);
  std::vector<std::array<double, entries>> blocks;
  const auto add = [](std::array<double, entries>& sum, std::size_t first, const Vec3& a) {
    sum[first] += a.x;
    sum[first + 1] += a.y;
    sum[first + 2] += a.z;
  };
  const auto sums = ordered_sums(world, blocks, [&](std::size_t i, std::array<double, entries>& sum) {
    if (is_member(i)) return;
    const Vec3 r = world.unwrapped(i), P = m[i] * v.at(i);
    add(sum, momentum, P);
    add(sum, angular, cross(r, P));
    sum[kinetic] += 0.5 * dot(v.at(i), P);
    sum[potential] -= m[i] * dot(world.scene.gravity, r);
  });
  ledger.momentum += {sums[momentum], sums[momentum + 1], sums[momentum + 2]};
  ledger.angular_momentum += {sums[angular], sums[angular + 1], sums[angular + 2]};
  ledger.energy[ledger_entry::kinetic] += sums[kinetic];
  ledger.energy[ledger_entry::potential] += sums[potential];
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"motion",
               scene.mode_of(term::time),
               {},
               fields::joined({fields::position(), fields::velocity(), {field::mass, field::body}})};
  s.reads_if_there = fields::joined({fields::image(), fields::shift(), {field::driven}});
  s.sums_forces = true;
  s.skips_sleeping = true;
  return s;
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<FreeMotion>(); }

}  // namespace tripoint::motion
