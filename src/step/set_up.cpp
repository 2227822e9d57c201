// SPDX-License-Identifier: BSD-3-Clause
// The state of a run before its first step: fields, particles, bodies, bonds, neighbours.
#include <algorithm>

#include "core/errors.hpp"
#include "scene/effect_rule.hpp"
#include "solids/solid_particles.hpp"
#include "state/body_table.hpp"
#include "step/each_effect.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

PeriodicBox box_of(const Scene& scene) {
  PeriodicBox box;
  box.periodic = scene.periodic;
  if (!box.any()) return box;
  if (!scene.min || !scene.max) throw InputError("a periodic scene needs the domain's min and max");
  box.min = *scene.min;
  box.width = *scene.max - *scene.min;
  return box;
}

/// Whether no particle can ever move: then lists need no skin and are never built anew.
bool is_static(const Scene& scene, const InitialState& initial) {
  const auto at_rest = [](const Vec3& v) { return v == Vec3{}; };
  if (!scene.inflows.empty()) return false;
  if (std::ranges::any_of(
          scene.bodies, [](const Body& b) { return b.phase == Phase::liquid && b.motion != Motion::fixed; }))
    return false;
  if (calls_for(scene, &EffectRule::frees_particles)) return false;
  const bool all_fixed =
      std::ranges::all_of(scene.bodies, [](const Body& b) { return b.motion == Motion::fixed; });
  if (all_fixed) return scene.events.empty();
  const bool none_prescribed =
      std::ranges::none_of(scene.bodies, [](const Body& b) { return b.motion == Motion::prescribed; });
  return none_prescribed && at_rest(scene.gravity) && std::ranges::all_of(initial.velocity, at_rest) &&
         scene.events.empty() && scene.forces.empty() && scene.springs.empty() && scene.joints.empty();
}

/// Whether the scene has only liquids and fixed bodies, laid at rest.
bool is_still(const Scene& scene, const InitialState& initial) {
  const auto rests = [](const Body& b) { return b.phase == Phase::liquid || b.motion == Motion::fixed; };
  return scene.inflows.empty() && scene.events.empty() && std::ranges::all_of(scene.bodies, rests) &&
         std::ranges::all_of(initial.velocity, [](const Vec3& v) { return v == Vec3{}; });
}

std::vector<FieldInfo> fields_of(const Scene& scene, const std::vector<Active>& effects) {
  std::vector<FieldInfo> fields = common_fields(scene.periodic[0] || scene.periodic[1] || scene.periodic[2]);
  if (can_have_bodies(scene)) {
    const std::vector<FieldInfo> table = body_table_fields();
    fields.insert(fields.end(), table.begin(), table.end());
  }
  for (const Active& a : effects) fields.insert(fields.end(), a.spec.owns.begin(), a.spec.owns.end());
  return fields;
}

}  // namespace

void Simulation::set_up(const Scene& scene, const InitialState& initial) {
  state_.scene = scene;
  state_.threads = options_.threads;
  state_.axis_order = options_.axis_order;
  state_.box = box_of(scene);
  declare(state_, effects_);
  guards_.still = is_still(scene, initial);
  state_.can_hold_sums = passes_.can_hold();
  load(initial);
  enclosure_ = enclosure_of(scene, initial);
  if (passes_.needed())
    state_.neighbours.emplace(state_.support(),
                              is_static(scene, initial) ? 0.0 : options_.skin * state_.support(), state_.box,
                              options_.threads, passes_.lanes());
  schedule_ = Schedule(scene.events);
}

void Simulation::load(const InitialState& initial) {
  const std::vector<FieldInfo> fields = fields_of(state_.scene, effects_);
  state_.particles = Particles(initial.size(), fields);
  state_.bodies = Columns(0, Per::body, fields);
  Particles& p = state_.particles;
  const auto x = positions(p), v = velocities(p);
  for (std::size_t i = 0; i < initial.size(); ++i) {
    x.set(i, initial.position[i]);
    v.set(i, initial.velocity[i]);
    p[field::mass][i] = initial.mass[i];
    p[field::phase][i] = initial.phase[i];
    p[field::body][i] = initial.body[i];
    p[field::material][i] = initial.material[i];
    p[field::source][i] = initial.source[i];
  }
  add_scene_bodies(state_);
  solid::connect_solids(state_);
  for_each_effect(state_, effects_, [&](Effect& effect) { effect.load(state_, initial); });
}

}  // namespace tripoint
