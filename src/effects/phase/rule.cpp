// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::phase {
namespace {

std::string called_for(const Scene& s) {
  return because(who_changes_phase(s), "the scene's temperatures pass t_melt or t_solid of the material");
}

/// The proof that nothing melts or freezes.
std::string left_out(const Scene& s) {
  if (!any_material(s, [](const Material& m) { return m.t_melt.has_value(); }))
    return "no material has a t_melt";
  const TemperatureRange range = temperatures_of(s);
  if (range.empty()) return "no temperature is given";
  return fmt::format(
      "bodies, inflows and events have {:.6g} to {:.6g} K, conduction never leaves that range, and no solid "
      "there melts and no "
      "liquid freezes",
      range.least, range.greatest);
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "t_melt", number, "K", positive, "", "does not melt", "",
        "above it the matter is liquid"},
       &Material::t_melt},
      {{"material", "t_solid", number, "K", positive, "=", "t_melt: no soft band and no hysteresis", "",
        "below it the matter is solid; at most t_melt"},
       &Material::t_solid},
      {{"material", "latent_heat", number, "J/kg", not_negative, "=", "melts at once where t_melt is given",
        "", "heat of fusion"},
       &Material::latent_heat},
      {{"material", "softens", flag, "", any, "false", "full stiffness up to melting", "",
        "stiffness falls with the liquid fraction. With solid = \"rigid\", young_modulus and model.phase = "
        "\"paper\": elastic "
        "between t_solid and t_melt (Fig. 5)"},
       &Material::softens},
  };
}

/// Whether bodies are joined or parted without any change of phase.
bool joins_bodies(const Scene& s) {
  const auto regroups = [](const Event& e) {
    return e.kind == Event::Kind::merge || e.kind == Event::Kind::split;
  };
  return std::ranges::any_of(s.events, regroups) ||
         any_body(s, [](const Scene&, const Body& b, const Material&) { return !b.joined_to.empty(); });
}

void settle_material(TableReader& in, Material& m) {
  for (const auto& [key, given] :
       {std::pair{"t_solid", m.t_solid.has_value()}, std::pair{"latent_heat", m.latent_heat.has_value()}})
    if (given && !m.t_melt) in.refuse(key, "without t_melt the material does not melt: give t_melt too");
  if (m.softens && !m.t_melt)
    in.refuse("softens", "without t_melt the material does not melt: give t_melt too, or remove softens");
  if (!m.t_melt) return;
  if (!m.t_solid) {
    m.t_solid = m.t_melt;
    in.ruled("t_solid", show(*m.t_solid), "t_melt: no soft band and no hysteresis");
  }
  if (!m.latent_heat) {
    m.latent_heat = 0.0;
    in.ruled("latent_heat", "0", "melts at once");
  }
  if (*m.t_solid > *m.t_melt)
    in.refuse(
        "t_solid",
        fmt::format("{} K is above t_melt = {} K: matter is solid below t_solid and liquid above t_melt; "
                    "give a t_solid of at most t_melt",
                    *m.t_solid, *m.t_melt));
}

}  // namespace

EffectRule rule() {
  return {.name = "phase",
          .called_for = called_for,
          .left_out = left_out,
          .terms = {{term::phase, {{"enthalpy", "by the heat content (8.9)"}}}},
          .keys = keys(),
          .scene_keys = {{"merge_distance", joins_bodies}},
          .settle_material = settle_material,
          .ledger_entries = {{"phase_work", "work that melting and freezing took"}},
          .over_processes = true,
          .has_bonds = true,
          .makes_bodies = true,
          .frees_particles = true,
          .changes_temperatures = true};
}

}  // namespace tripoint::phase
