// SPDX-License-Identifier: BSD-3-Clause
#include "effects/motion/motion.hpp"

#include <algorithm>
#include <cmath>

#include "scene/ledger_entry.hpp"
#include "scene/shared_terms.hpp"
#include "state/body_table.hpp"
#include "state/free_rows.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::motion {
namespace {

enum Work : std::size_t { by_gravity = gravity_work, works_on_driven, works = works_on_driven + most_forces };

/// Moves the velocities of particles on and adds up the works on them.
struct Kick {
  FreeRows free;
  FreeLoops loops;
  Triple<double> v;
  RigidMembers is_member;
  std::span<const int> driven;  ///< empty: nobody guides a particle
  double dt;

  void rows(std::size_t from, std::size_t to, std::array<double, works>& work) const {
    is_member.each_run_of_others(from, to, [&](std::size_t first, std::size_t past) {
      while (first < past) {
        std::size_t guided = first;
        while (guided < past && (driven.empty() || driven[guided] == 0)) ++guided;
        loops.kick(free, {v.x.data(), v.y.data(), v.z.data()}, dt, first, guided, work.data());
        for (first = guided; first < past && driven[first] != 0; ++first)  // its driver takes the work
          for (std::size_t k = 0; k < free.forces; ++k)
            work[works_on_driven + k] += dt * dot(free.force_on(first, k), v.at(first));
      }
    });
  }
};

class FreeMotion : public Effect {
 public:
  void kick(State&, double dt) override;
  void drift(State&, double dt) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;
  void lose(State&, std::span<const std::size_t> rows) override;

 private:
  std::vector<std::array<double, works>> blocks_;  ///< memory that is used again
};

/// v += dt (sum F/m + g). The work of each force is accumulated by its own formula, dt F.(v- + v+)/2. The sum
/// of these works is the change of kinetic energy to round-off (model 8.11).
void FreeMotion::kick(State& state, double dt) {
  Particles& p = state.particles;
  const auto driven = p.has(field::driven.name) ? std::as_const(p)[field::driven] : std::span<const int>{};
  const FreeRows free = free_rows(state);
  const Kick kick{free, free_loops(free.forces), velocities(p), RigidMembers(state), driven, dt};
  const auto sums = ordered_sums(state, blocks_, kick);
  for (std::size_t k = 0; k < state.forces.size(); ++k) {
    state.accumulated[state.forces[k].work] += sums[k];
    state.accumulated[work_on_driven(state.forces[k])] += sums[works_on_driven + k];
  }
  state.accumulated[account::gravity_work] += sums[by_gravity];
}

/// r += dt v; with the transport velocity of the scene's choice, dt (v + shift).
void FreeMotion::drift(State& state, double dt) {
  Particles& p = state.particles;
  const auto r = positions(p), v = velocities(p);
  const bool shifts = p.has(field::shift);
  const auto w = shifts ? triple(std::as_const(p), field::shift) : Triple<const double>{};
  const RigidMembers is_member(state);
  const bool guided = p.has(field::driven.name);
  const auto driven = guided ? std::as_const(p)[field::driven] : std::span<const int>{};
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.moving(); ++i)
    if (!is_member(i) && !(guided && driven[i] != 0))
      r.set(i, r.at(i) + dt * (shifts ? v.at(i) + w.at(i) : v.at(i)));
  state.moved = true;
}

/// 0.25 sqrt(h/|a|max) (model 8.10).
TimeStepBound FreeMotion::max_dt(const State& state) const {
  const Particles& p = state.particles;
  const FreeRows rows = free_rows(state);
  const FreeLoops loops = free_loops(rows.forces);
  const RigidMembers is_member(state);
  const double a2 = greatest_of_blocks(p.moving(), state.threads, [&](std::size_t from, std::size_t to) {
    double most = 0.0;
    is_member.each_run_of_others(from, to, [&](std::size_t first, std::size_t past) {
      most = std::max(most, loops.greatest_acceleration2(rows, first, past));
    });
    return most;
  });
  TimeStepBound bound;
  if (a2 > 0.0) tighten(bound, acceleration_step(state.support(), std::sqrt(a2)), "acceleration");
  return bound;
}

void FreeMotion::add_to(const State& state, Ledger& ledger) const {
  enum Entry : std::size_t { momentum, angular = 3, kinetic = 6, potential, entries };
  const Particles& p = state.particles;
  const auto m = p[field::mass];
  const auto v = velocities(p);
  const RigidMembers is_member(state);
  std::vector<std::array<double, entries>> blocks;
  const auto add = [](std::array<double, entries>& sum, std::size_t first, const Vec3& a) {
    sum[first] += a.x;
    sum[first + 1] += a.y;
    sum[first + 2] += a.z;
  };
  const auto sums = ordered_sums(state, blocks, [&](std::size_t i, std::array<double, entries>& sum) {
    if (is_member(i)) return;
    const Vec3 r = state.unwrapped(i), P = m[i] * v.at(i);
    add(sum, momentum, P);
    add(sum, angular, cross(r, P));
    sum[kinetic] += 0.5 * dot(v.at(i), P);
    sum[potential] -= m[i] * dot(state.scene.gravity, r);
  });
  ledger.momentum += {sums[momentum], sums[momentum + 1], sums[momentum + 2]};
  ledger.angular_momentum += {sums[angular], sums[angular + 1], sums[angular + 2]};
  ledger.energy[ledger_entry::kinetic] += sums[kinetic];
  ledger.energy[ledger_entry::potential] += sums[potential];
}

void FreeMotion::lose(State& state, std::span<const std::size_t> rows) {
  const auto m = state.particles[field::mass];
  for (const std::size_t i : rows) {
    const Vec3 v = state.particles.velocity(i);
    const double potential = -m[i] * dot(state.scene.gravity, state.unwrapped(i));
    state.accumulated[account::outflow] += 0.5 * m[i] * dot(v, v) + potential;
    state.accumulated[account::driven_potential] -= potential;
  }
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
