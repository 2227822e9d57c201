// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/all_effects.hpp"

#include <algorithm>
#include <array>

#include "pairs/scene_passes.hpp"
#include "scene/effect_rule.hpp"
#include "state/body_table.hpp"

#ifndef TRIPOINT_EFFECT_LIST
#define TRIPOINT_EFFECT_LIST "effects/effect_list.inc"
#endif

namespace tripoint {

#define TRIPOINT_EFFECT(name)                 \
  namespace name {                            \
  EffectSpec spec(const Scene&);              \
  std::unique_ptr<Effect> make(const Scene&); \
  }
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT

namespace {

struct Registered {
  std::string_view name;
  EffectSpec (*spec)(const Scene&);
  std::unique_ptr<Effect> (*make)(const Scene&);
};

/// In the order in which they run within a stage.
constexpr Registered every_effect[] = {
#define TRIPOINT_EFFECT(name) {#name, name::spec, name::make},
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT
};

/// Whether this build has an effect: TRIPOINT_EFFECTS lists those that it has, between commas; without it it
/// has all.
constexpr bool in_build(const Registered& effect) {
#ifdef TRIPOINT_EFFECTS
  constexpr std::string_view list = TRIPOINT_EFFECTS;
  for (std::size_t at = list.find(effect.name); at != list.npos; at = list.find(effect.name, at + 1))
    if (list[at - 1] == ',' && list[at + effect.name.size()] == ',') return true;
  return false;
#else
  return !effect.name.empty();
#endif
}

/// The effects of this build; an effect that it leaves out is in no table, so that the linker leaves it out
/// too.
constexpr auto all_effects = [] {
  std::array<Registered, static_cast<std::size_t>(std::ranges::count_if(every_effect, in_build))> list{};
  std::ranges::copy_if(every_effect, list.begin(), in_build);
  return list;
}();

const Registered* find(std::string_view name) {
  const auto* place = std::ranges::find(all_effects, name, &Registered::name);
  return place == std::end(all_effects) ? nullptr : place;
}

/// @throws InputError when two effects own a field, or one is read and owned by none
void check_ownership(const std::vector<Active>& effects, bool periodic) {
  struct Owned {
    FieldInfo field;
    std::string owner;
  };
  std::vector<Owned> owned;
  for (const FieldInfo& f : common_fields(periodic)) owned.push_back({f, "particles"});
  for (const FieldInfo& f : body_table_fields()) owned.push_back({f, "bodies"});
  const auto owner_of = [&](const FieldInfo& f) { return std::ranges::find(owned, f, &Owned::field); };
  for (const Active& a : effects) {
    for (const FieldInfo& f : a.spec.owns) {
      const auto other = owner_of(f);
      if (other != owned.end()) {
        throw InputError("the field " + std::string(f.name) + " is owned by two effects, " + other->owner +
                         " and " + a.name);
      }
      owned.push_back({f, a.name});
    }
  }
  for (const Active& a : effects) {
    for (const FieldInfo& f : a.spec.reads) {
      if (owner_of(f) != owned.end()) continue;
      throw InputError("the effect " + a.name + " reads the field " + std::string(f.name) +
                       ", which no effect of this scene owns");
    }
  }
}

/// @throws InputError when an effect bounds a field that it does not own, of which a scene may have no column
void check_bounds(const std::vector<Active>& effects) {
  const auto owned_by = [](const Active& a, const FieldInfo& f) {
    if (std::ranges::find(a.spec.owns, f) == a.spec.owns.end())
      throw InputError("the effect " + a.name + " bounds the field " + std::string(f.name) +
                       " and does not own it");
  };
  for (const Active& a : effects) {
    for (const Bounded& b : a.spec.bounded) owned_by(a, b.field);
    for (const Field<double>& f : a.spec.positive) owned_by(a, f);
  }
}

/// Columns that each effect may ask for: those that it owns and reads, the table of bodies, and all forces
/// where it sums them.
void set_declared(std::vector<Active>& effects) {
  std::vector<FieldInfo> forces;
  for (const Active& a : effects)
    for (const Force& f : a.spec.forces) {
      forces.insert(forces.end(), {f.field.get().x, f.field.get().y, f.field.get().z});
      if (f.couple) forces.insert(forces.end(), {f.couple->get().x, f.couple->get().y, f.couple->get().z});
    }
  for (Active& a : effects) {
    a.declared.who = a.name;
    const auto add = [&](const std::vector<FieldInfo>& fields) {
      for (const FieldInfo& f : fields) a.declared.keys.push_back(f.key);
    };
    add(a.spec.owns);
    add(a.spec.reads);
    add(a.spec.reads_if_there);
    add(body_table_fields());
    if (a.spec.sums_forces) add(forces);
    std::ranges::sort(a.declared.keys);
  }
}

/// Of the columns that every scene has, and of the table of bodies where there is one.
std::vector<Bounded> common_bounds(const Scene& scene) {
  std::vector<Bounded> bounds{
      {field::body, -1, [](const State& w) { return w.bodies.size(); }},
      {field::phase, 0, [](const State&) -> std::size_t { return 3; }},  // phases
      {field::material, 0, [](const State& w) { return w.scene.materials.size(); }},
      {field::source, 0, [](const State& w) { return w.scene.bodies.size() + w.scene.inflows.size(); }}};
  if (!can_have_bodies(scene)) return bounds;
  const std::vector<Bounded> of_bodies = body_table_bounds();
  bounds.insert(bounds.end(), of_bodies.begin(), of_bodies.end());
  return bounds;
}

/// @throws InputError when two effects declare a force's columns or an energy account, or there are more
/// forces than sums have room for
void check_forces(const std::vector<Active>& effects) {
  std::vector<EnergyAccount> seen;
  std::size_t forces = 0;
  const auto once = [&](const EnergyAccount& a, const std::string& who) {
    if (std::ranges::find(seen, a) != seen.end() || EnergyAccounts().has(a))
      throw InputError("the energy account " + std::string(a.name) + " of the effect " + who +
                       " is declared twice");
    seen.push_back(a);
  };
  for (const Active& a : effects) {
    for (const Force& f : a.spec.forces) {
      ++forces;
      if (std::ranges::find(a.spec.owns, FieldInfo(f.field.get().x)) == a.spec.owns.end())
        throw InputError("the effect " + a.name + " makes the force " + std::string(f.field.get().x.name) +
                         " and does not own it");
      if (!f.stored && f.entry.empty())
        throw InputError("the work of the force " + std::string(f.field.get().x.name) +
                         " has no entry of the ledger, and no energy stores it");
      once(f.work, a.name);
      if (f.work_on_driven) once(*f.work_on_driven, a.name);
      if (f.stored) once(f.stored->at_start, a.name);
    }
    for (const EnergyAccount& one : a.spec.accounts) once(one, a.name);
    for (const EnergyAccount& one : a.spec.numerical) once(one, a.name);
  }
  if (forces > most_forces)
    throw InputError("the effects of this scene make " + std::to_string(forces) +
                     " forces, and sums have room for " + std::to_string(most_forces));
}

}  // namespace

std::string missing_effect(const Scene& scene) {
  for (const CalledEffect& called : needed_effects(scene)) {
    if (!find(called.name)) return called.name;
  }
  return {};
}

std::vector<Active> active_effects(const Scene& scene) {
  const std::vector<CalledEffect> calls = needed_effects(scene);
  if (const std::string missing = missing_effect(scene); !missing.empty()) {
    throw InputError("tripoint: the " + missing + " effect is not in this build");
  }
  std::vector<Active> list;
  for (const Registered& r : all_effects) {
    const auto call = std::ranges::find(calls, r.name, &CalledEffect::name);
    if (call != calls.end())
      list.push_back({std::string(r.name), call->why, r.spec(scene), r.make(scene), {}});
  }
  check_ownership(list, scene.periodic[0] || scene.periodic[1] || scene.periodic[2]);
  check_bounds(list);
  check_forces(list);
  set_declared(list);
  return list;
}

Plan plan(const Scene& scene) {
  Plan p;
  const auto add = [&](const FieldInfo& f, const std::string& owner) {
    p.fields.push_back(
        {std::string(f.name), std::string(f.unit), std::string(to_string(f.per)), owner, f.bytes});
    if (f.per == Per::particle) p.bytes_per_particle += f.bytes;
  };
  for (const FieldInfo& f : common_fields(scene.periodic[0] || scene.periodic[1] || scene.periodic[2]))
    add(f, "particles");
  if (can_have_bodies(scene))
    for (const FieldInfo& f : body_table_fields()) add(f, "bodies");
  // An effect that is called for and not in this build is listed all the same: explain says what a scene
  // means.
  for (const CalledEffect& c : needed_effects(scene)) {
    if (!find(c.name))
      p.effects.push_back({c.name, c.why + " (not in this build)", std::string(to_string(scene.mode))});
  }
  if (!p.effects.empty()) return p;
  const std::vector<Active> active = active_effects(scene);
  // Bodies that are driven call for the rigid effect too
  for (const CalledEffect& idle : idle_effects(scene)) {
    if (std::ranges::find(active, idle.name, &Active::name) == active.end())
      p.idle.push_back({idle.name, idle.why, {}});
  }
  for (const Active& a : active) {
    p.effects.push_back({a.name, a.why, std::string(to_string(a.spec.mode))});
    for (const FieldInfo& f : a.spec.owns) add(f, a.name);
  }
  return p;
}

std::vector<EffectPairWork> pair_work(const Scene& scene, const std::vector<Active>& effects) {
  std::vector<EffectPairWork> all;
  for (const Active& a : effects)
    all.push_back({a.effect->pair_work(scene), a.declared, a.spec.skips_sleeping});
  return all;
}

std::vector<char> idle_particles(const Scene& scene, const InitialState& initial) {
  const std::vector<Active> effects = active_effects(scene);
  if (Passes(scene, pair_work(scene, effects), 1).works_on_all()) return {};
  std::vector<char> idle;
  for (const int source : initial.source)
    idle.push_back(scene.bodies[static_cast<std::size_t>(source)].motion == Motion::fixed);
  return idle;
}

void declare(State& state, const std::vector<Active>& effects) {
  for (const Field<double>* f : columns_of(field::position))
    state.guarded.push_back({*f, "position", Written::drift});
  for (const Field<double>* f : columns_of(field::velocity))
    state.guarded.push_back({*f, "velocity", Written::kick});
  state.bounded = common_bounds(state.scene);
  state.positive = {field::mass};
  for (const Active& a : effects) {
    for (const Force& f : a.spec.forces) {
      state.forces.push_back(f);
      state.accumulated.open(f.work);
      state.accumulated.open(work_on_driven(f));
      if (f.stored) state.accumulated.open(f.stored->at_start);
    }
    for (const EnergyAccount& one : a.spec.accounts) state.accumulated.open(one);
    for (const EnergyAccount& one : a.spec.numerical) state.accumulated.open(one);
    state.numerical.insert(state.numerical.end(), a.spec.numerical.begin(), a.spec.numerical.end());
    state.guarded.insert(state.guarded.end(), a.spec.guards.begin(), a.spec.guards.end());
    state.bounded.insert(state.bounded.end(), a.spec.bounded.begin(), a.spec.bounded.end());
    state.positive.insert(state.positive.end(), a.spec.positive.begin(), a.spec.positive.end());
    state.guarded_entries.insert(state.guarded_entries.end(), a.spec.guarded_entries.begin(),
                                 a.spec.guarded_entries.end());
    for (const StepNumber& one : a.spec.step_numbers) state.step_numbers.declare(one);
    state.body_sums.insert(state.body_sums.end(), a.spec.body_sums.begin(), a.spec.body_sums.end());
  }
  std::ranges::stable_sort(state.guarded, {}, &Guarded::written);
}

}  // namespace tripoint
