// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "liquids/carried_density.hpp"
#include "liquids/compression_energy.hpp"
#include "liquids/pressing_gravity.hpp"
#include "liquids/stored_compression.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::pressure {
namespace {

bool has_stiffness(const Material& m) { return m.stiffness.has_value(); }

bool can_break(const Scene&, const Body& b, const Material& m) {
  return b.phase == Phase::elastic && (m.fracture_stretch || m.fracture_distance);
}

/// Bodies that can meet others: contact needs a stiffness, two bodies, or one that can break in two, and one
/// of them free.
std::string who_can_touch(const Scene& s) {
  const bool any_free = std::ranges::any_of(s.bodies, [](const Body& b) { return b.motion == Motion::free; });
  if (!s.contact || !any_material(s, has_stiffness) || !any_free ||
      (s.bodies.size() < 2 && !any_body(s, can_break)))
    return "";
  return bodies_where(s, [](const Scene&, const Body&, const Material&) { return true; });
}

/// Whether what melts can be pressed or pulled.
bool flows(const Scene& s) { return any_material(s, has_stiffness) || s.gravity != Vec3{}; }

/// Where liquids carry their density solids alone meet by the sum (4).
std::string who_can_meet(const Scene& s) {
  const auto solids = std::ranges::count_if(s.bodies, [](const Body& b) { return b.phase != Phase::liquid; });
  const auto is_free = [](const Body& b) { return b.phase != Phase::liquid && b.motion == Motion::free; };
  const bool moves_later =
      std::ranges::any_of(s.events, [](const Event& e) { return e.kind != Event::Kind::heat; });
  if (!s.contact || !(std::ranges::any_of(s.bodies, is_free) || moves_later)) return "";
  if (solids < 2 && !any_body(s, can_break) && !moves_later) return "";
  return bodies_where(s,
                      [](const Scene&, const Body& b, const Material&) { return b.phase != Phase::liquid; });
}

std::string called_for(const Scene& s) {
  if (liquid::carries_density(s)) {
    if (const std::string who = who_changes_phase(s); !who.empty() && flows(s))
      return because(who, "what freezes can touch");
    return because(who_can_meet(s), "solids, one of them free: they can touch");
  }
  std::string liquid = bodies_where(s, [](const Scene& scene, const Body& b, const Material&) {
    return b.phase == Phase::liquid && moves(scene, b);
  });
  if (liquid.empty() && !s.inflows.empty()) liquid = "an inflow";
  if (!liquid.empty()) return because(liquid, "liquid, and not held in place");
  if (const std::string touch = who_can_touch(s); !touch.empty())
    return because(touch, "more than one body, one of them free, and a stiffness: they can touch");
  return flows(s) ? because(who_changes_phase(s), "what melts flows") : "";
}

std::string left_out(const Scene& s) {
  if (liquid::carries_density(s)) return "liquids carry their density, and nothing else can touch";
  if (any_body(s, liquid::is_liquid)) return "every liquid is held in place, and nothing can touch";
  if (!s.contact) return "nothing is liquid, and the scene says contact = \"none\"";
  if (!any_material(s, has_stiffness))
    return "nothing is liquid, no two bodies can meet before the end of the run, and no material has a "
           "stiffness";
  return "nothing is liquid, and no free body has another to touch";
}

/// Why the topmost layer of a liquid can bear no part of its own weight.
/// The reasons are those of the numerical bulk viscosity, or there is no gravity. Or a free body floats at
/// the surface and loads it by an unknown weight.
std::string no_surface_weight(const Scene& scene) {
  if (any_body(scene, [](const Scene&, const Body& b, const Material&) {
        return b.phase != Phase::liquid && b.motion == Motion::free;
      }))
    return "a free body that floats would be lifted by it";
  if (liquid::pressing_gravity(scene) == Vec3{})
    return "gravity presses nothing down: there is none, or it acts along periodic directions alone";
  return liquid::no_compression_energy(scene);
}

std::string no_core(const Scene& scene) {
  return scene.mode_of(term::pressure) == Mode::paper ? "the pressure is as printed, and has no core" : "";
}

/// Numbers of the terms beside the equation of state of liquids (model 8.3, 8.4).
std::vector<EffectKey> pressure_keys() {
  using enum Range;
  return {
      {old_key("bulk_viscosity", not_negative, "0.2",
               "numerical bulk viscosity of liquids over rho0 c h, h the support (model 8.4)"),
       {},
       liquid::no_compression_energy},
      {old_key("core_reach", fraction, "0.9",
               "distance in spacings below which pressing pairs repel (model 8.3)"),
       {},
       no_core},
      {old_key("surface_weight", not_negative, "0.5",
               "fraction of its weight that the topmost layer of a liquid bears as pressure (model 8.3)"),
       {},
       no_surface_weight},
  };
}

/// Keys of a material.
std::vector<EffectKey> material_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "stiffness", number, "m2/s2", positive, "",
        "from the speeds of the scene or elastic moduli", "",
        "k of p = k (rho - rho0), the square of the sound speed"},
       &Material::stiffness},
      {{"material", "sound_speed", number, "m/s", positive, "", "see stiffness", "",
        "instead of stiffness: k is its square"},
       EffectKey::ByRule{}},
  };
}

/// Keys of the case file, in the order of its reference page.
std::vector<EffectKey> keys() {
  std::vector<EffectKey> all;
  for (const auto& group : {pressure_keys(), material_keys()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<DeclaredTerm> terms() {
  return {{term::pressure, {{"conservative", "the gradient of an energy of compression (8.3)"}}},
          {term::density, {{"number", "number density over its lattice sum (8.2)"}}},
          {term::state, {{"scaled", "all liquids equally hard to compress (8.3)"}}},
          {term::clamp, {{"clamped", "no pressure below zero"}}, TermKind::law, false}};
}

std::vector<ModelChoice> choices() {
  return {{"bulk_viscosity",
           {{"numerical", "of liquids, 0.2 rho0 c h (8.4)", {{"bulk_viscosity", 0.2}}},
            {"thick", "rho0 c h", {{"bulk_viscosity", 1.0}}},
            {"none", "", {{"bulk_viscosity", 0.0}}}},
           "damps the sound that a liquid's start emits"},
          {"core",
           {{"repulsive", "pairs repel below 0.9 spacings (8.3)", {{"core_reach", 0.9}}},
            {"none", "", {{"core_reach", 0.0}}}},
           "keeps pairs apart where the clamp leaves no pressure"},
          {"surface",
           {{"weighted", "the topmost layer bears half of its weight (8.3)", {{"surface_weight", 0.5}}},
            {"none", "", {{"surface_weight", 0.0}}}},
           "half of its own weight lies above the middle of a layer"}};
}

void settle_material(TableReader& in, Material& m) {
  const auto c = in.maybe_number("sound_speed");
  if (!c) return;
  if (in.has("stiffness"))
    in.refuse("sound_speed", "stiffness is given too, and is its square: give one of them");
  m.stiffness = *c * *c;
  in.ruled("stiffness", show(*m.stiffness), "the square of sound_speed");
}

std::vector<std::string_view> always_reported(const Scene& scene) {
  return {liquid::stores_compression(scene) ? "compression" : "pressure_work"};
}

}  // namespace

EffectRule rule() {
  return {.name = "pressure",
          .called_for = called_for,
          .left_out = left_out,
          .terms = terms(),
          .terms_shared = {term::kernel},
          .choices = choices(),
          .keys = keys(),
          .scene_keys = {{"clamp"}},
          .settle_material = settle_material,
          .ledger_entries = {{"compression", "liquid that is compressed, where its pressure has an energy"},
                             {"pressure_work",
                              "in place of `compression`: work that the printed form of pressure took"},
                             {"phase_work"},
                             {"bulk_viscous", "work that the numerical bulk viscosity took"}},
          .always_reported = always_reported,
          .over_processes = true,
          .has_pairs = true,
          .has_pressure = true};
}

}  // namespace tripoint::pressure
