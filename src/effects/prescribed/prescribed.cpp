// SPDX-License-Identifier: BSD-3-Clause
#include "effects/prescribed/prescribed.hpp"

#include <algorithm>
#include <utility>

#include "effects/prescribed/fields.hpp"
#include "effects/prescribed/inflow.hpp"
#include "scene/geometry.hpp"
#include "scene/shared_terms.hpp"
#include "solids/grip.hpp"
#include "state/body_table.hpp"

namespace tripoint::prescribed {
namespace {

class Prescribed : public Effect {
 public:
  void load(State&, const InitialState&) override;
  void drift(State&, double dt) override;
  [[nodiscard]] bool wants_change(State&) override;
  void change(State&) override;
  void adopt(State&) override;
  void happen(State&, const Happening&) override;
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["inflow"] -= state.accumulated[account::inflow];
  }

 private:
  std::vector<Entrance> entrances_;
};

/// Kinetic and potential energy of a particle [J].
double energy_of(const State& state, std::size_t row) {
  const Vec3 v = state.particles.velocity(row);
  return state.particles[field::mass][row] *
         (0.5 * dot(v, v) - dot(state.scene.gravity, state.unwrapped(row)));
}

/// A particle as its guide moves it; the energy that this costs is accumulated at the walls.
void guide(State& state, std::size_t row, const Vec3& place, const Vec3& velocity) {
  const double before = energy_of(state, row);
  const Vec3 way = place - state.unwrapped(row);
  const auto r = positions(state.particles);
  r.set(row, r.at(row) + way);
  velocities(state.particles).set(row, velocity);
  if (!state.owns(row)) return;
  state.accumulated[account::walls] -= energy_of(state, row) - before;
  state.accumulated[account::driven_potential] -=
      state.particles[field::mass][row] * dot(state.scene.gravity, way);
}

void Prescribed::load(State& state, const InitialState&) {
  entrances_.clear();
  for (std::size_t n = 0; n < state.scene.inflows.size(); ++n) entrances_.emplace_back(state.scene, n);
}

void Prescribed::drift(State& state, double dt) {
  Particles& p = state.particles;
  const auto driven = p[field::driven];
  const RigidMembers is_member(state);
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (driven[i] == 0 || driven[i] == driven_still || is_member(i)) continue;
    if (driven[i] == driven_in) {
      const int from = inflow_of(state, i);
      if (from < 0) continue;  // a checkpoint whose columns do not agree
      const Entrance& e = entrances_[static_cast<std::size_t>(from)];
      const Vec3 r = state.unwrapped(i), v = e.velocity(e.column_of(r));
      guide(state, i, r + e.way(state.time, state.next_time, dt) * v, e.opening(state.next_time) * v);
    } else {
      const Event& grip = state.scene.events[static_cast<std::size_t>(driven[i] - driven_grip)];
      const PrescribedState s = carried(grip, p.vector(i, field::grip), state.next_time);
      guide(state, i, s.position, s.velocity);
    }
    state.moved = true;
  }
}

/// A part of a shared scene does not know the layers of its particles. It checks whether as many have entered
/// as should have, and whether one is about to leave the shape.
bool Prescribed::wants_change(State& state) {
  if (entrances_.empty() || state.ghosts.empty()) return !entrances_.empty();
  const auto driven = std::as_const(state.particles)[field::driven];
  std::vector<double> there(entrances_.size(), 0.0);
  bool leaves = false;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const int from = inflow_of(state, i);
    if (from < 0 || !state.owns(i)) continue;
    there[static_cast<std::size_t>(from)] += 1.0;
    leaves = leaves || (driven[i] == driven_in &&
                        !entrances_[static_cast<std::size_t>(from)].surely_inside(state.unwrapped(i)));
  }
  state.add_up(there);
  for (std::size_t n = 0; n < entrances_.size(); ++n)
    leaves = leaves || there[n] < static_cast<double>(entrances_[n].particles_until(state.time));
  return leaves;
}

/// New layers enter; those that have left the shape are free.
void Prescribed::change(State& state) {
  if (entrances_.empty()) return;
  let_in(state, entrances_);
  Particles& p = state.particles;
  const auto driven = p[field::driven];
  // The last that came in are the last of their columns, whatever has left the scene since
  std::vector<std::vector<long>> layer;
  for (const Entrance& e : entrances_) {
    layer.emplace_back();
    for (std::size_t k = 0; k < e.section().size(); ++k)
      layer.back().push_back(e.layers_until(state.time, k));
  }
  for (std::size_t id = p.size(); id-- > 0;) {
    const std::size_t i = p.row(id);
    const int from = inflow_of(state, i);
    if (from < 0 || driven[i] != driven_in) continue;
    const auto n = static_cast<std::size_t>(from);
    const Entrance& e = entrances_[n];
    const std::size_t column = e.column_of(state.unwrapped(i));
    if (!e.inside(--layer[n][column], column, state.time)) driven[i] = 0;
  }
}

/// A particle that became a member of a rigid body moves with it.
void Prescribed::adopt(State& state) {
  const RigidMembers is_member(state);
  const auto driven = state.particles[field::driven];
  for (const std::uint32_t id : state.change.regrouped)
    if (const std::size_t i = state.particles.row(id); is_member(i)) driven[i] = 0;
}

bool named(const Event& event, const std::string& name) {
  return std::ranges::find(event.bodies, name) != event.bodies.end();
}

/// Of each particle that is no member of a rigid body, in the order of ids.
template <class Visit>
void each_loose(const State& state, Visit visit) {
  const RigidMembers is_member(state);
  for (std::size_t id = 0; id < state.particles.size(); ++id)
    if (const std::size_t i = state.particles.row(id); !is_member(i)) visit(i);
}

bool names_body_of(const State& state, const Event& event, std::size_t row) {
  const auto source = static_cast<std::size_t>(state.particles[field::source][row]);
  return source < state.scene.bodies.size() && named(event, state.scene.bodies[source].name);
}

void begin_grip(State& state, const Event& event, int number) {
  Particles& p = state.particles;
  const auto driven = p[field::driven], body = p[field::body];
  const auto place = triple(p, field::grip);
  const auto inside = inside_region(state.scene, *event.region);
  each_loose(state, [&](std::size_t i) {
    if (body[i] < 0 || !inside(state.unwrapped(i))) return;
    driven[i] = number;
    place.set(i, state.unwrapped(i));
  });
}

void end_grip(State& state, int number) {
  const auto driven = state.particles[field::driven];
  each_loose(state, [&](std::size_t i) {
    if (driven[i] == number) driven[i] = 0;
  });
}

/// Its bodies stay where they are as it begins, and no longer as it ends.
void hold(State& state, const Event& event, bool begins) {
  const auto driven = state.particles[field::driven];
  each_loose(state, [&](std::size_t i) {
    if (!names_body_of(state, event, i)) return;
    if (begins && driven[i] == 0) {
      driven[i] = driven_still;
      guide(state, i, state.unwrapped(i), {});
    } else if (driven[i] == driven_still) {
      driven[i] = 0;
    }
  });
}

/// Grips that it names let go, and bodies that it names are held no longer.
void release(State& state, const Event& event) {
  const auto driven = state.particles[field::driven];
  const auto grip_is_named = [&](int of) {
    return of >= driven_grip &&
           named(event, state.scene.events[static_cast<std::size_t>(of - driven_grip)].name);
  };
  each_loose(state, [&](std::size_t i) {
    if (grip_is_named(driven[i]) || (driven[i] == driven_still && names_body_of(state, event, i)))
      driven[i] = 0;
  });
}

void Prescribed::happen(State& state, const Happening& now) {
  const Event& event = now.event;
  const int number = driven_grip + static_cast<int>(&event - state.scene.events.data());
  if (event.kind == Event::Kind::hold) hold(state, event, now.begins);
  if (event.kind == Event::Kind::release) release(state, event);
  if (event.kind != Event::Kind::grip) return;
  if (now.begins)
    begin_grip(state, event, number);
  else
    end_grip(state, number);
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{
      "prescribed",
      scene.mode_of(term::time),
      {field::driven, field::grip},
      fields::joined({fields::position(),
                      fields::velocity(),
                      {field::id, field::mass, field::body, field::material, field::phase, field::source}})};
  s.bounded = {{field::driven, driven_in, [](const State& w) {
                  return static_cast<std::size_t>(driven_grip) + w.scene.events.size();
                }}};
  s.reads_if_there = fields::image();
  if (!scene.inflows.empty()) s.step_numbers = {let_in_until};
  s.changes = !scene.inflows.empty();
  s.skips_sleeping = true;
  s.guarded_entries = {{"inflow", EntryRole::apart}};
  return s;
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<Prescribed>(); }

}  // namespace tripoint::prescribed
