// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/effect_rule.hpp"
#include "scene/phase_values.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::heat {
namespace {

std::string called_for(const Scene& s) {
  const std::string who =
      bodies_where(s, [](const Scene&, const Body& b, const Material& m) { return has_heat(b, m); });
  const auto equal = who.empty() ? std::optional<double>() : equal_temperature(s);
  if (equal)
    return fmt::format(
        "all has {:.6g} K and nothing brings another temperature: no heat flows, none is computed", *equal);
  return because(who, "a temperature is given, and the material conducts");
}

std::string left_out(const Scene& s) {
  if (temperatures_of(s).empty()) return "no temperature is given";
  return "no body with a temperature has a conductivity and a heat_capacity";
}

std::string no_constant(const Scene& s) {
  return s.mode_of(term::heat) == Mode::paper ? ""
                                              : "heat is corrected, and conducts by what the materials say";
}

std::string no_held_surface(const Scene& s) {
  return any_material(s, [](const Material& m) { return value_of(m.values, "surface_temperature") > 0.0; })
             ? ""
             : "no material has a surface_temperature";
}

std::string as_printed(const Scene& s) {
  return s.mode_of(term::heat) == Mode::paper ? "heat as printed knows no surfaces" : "";
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "heat_constant", number, "m2/s", not_negative, "0",
        "each material has its own, conductivity/(density heat_capacity)", "",
        "the constant c of (21) of all matter, only where model.heat is paper; 0: a constant for each "
        "material"},
       {},
       no_constant},
      {{"material", "conductivity", number, "W/m/K", positive, "", "no heat flows", "",
        "thermal conductivity"},
       &Material::conductivity},
      {{"material", "heat_capacity", number, "J/kg/K", positive, "", "holds no heat", "",
        "specific heat at constant pressure"},
       &Material::heat_capacity},
      {{"material", "solid_conductivity", number, "W/m/K", positive, "",
        "conductivity is that of both phases", "",
        "conductivity of the solid; `conductivity` is then the liquid's; a correction"},
       &Material::solid_conductivity},
      {{"material", "solid_heat_capacity", number, "J/kg/K", positive, "",
        "heat_capacity is that of both phases", "",
        "specific heat of the solid; `heat_capacity` is then the liquid's, `latent_heat` that at t_melt; a "
        "correction"},
       &Material::solid_heat_capacity},
      {old_key("surface_exchange", not_negative, "1",
               "1: surface_temperature acts at the surface (model 8.6); 0: it holds the outermost particles"),
       {},
       no_held_surface},
      {{"material", "surface_temperature", number, "K", not_negative, "0", "nothing passes through surfaces",
        "",
        "temperature of the outer surfaces of fixed bodies, where they touch no body (model 8.6); 0: none. A "
        "body cut by "
        "scene.min or scene.max has a plane of symmetry there"},
       {},
       as_printed},
  };
}

/// Where the case gives a value of both phases, the library's of the solid is none of its.
void drop_of_library(TableReader& in, std::string_view key, std::string_view both,
                     std::optional<double>& value) {
  if (!value || in.has(key) || !in.has(both)) return;
  in.ruled(key, "none", fmt::format("{} is given, and is that of both phases", both));
  value.reset();
}

void settle_material(TableReader& in, Material& m) {
  drop_of_library(in, "solid_conductivity", "conductivity", m.solid_conductivity);
  drop_of_library(in, "solid_heat_capacity", "heat_capacity", m.solid_heat_capacity);
  for (const auto& [key, both, alone] :
       {std::tuple{"solid_conductivity", "conductivity", m.solid_conductivity && !m.conductivity},
        std::tuple{"solid_heat_capacity", "heat_capacity", m.solid_heat_capacity && !m.heat_capacity}})
    if (alone)
      in.refuse(
          key,
          fmt::format("{} is missing, which is the liquid's where the solid has its own: give it too", both));
  if (has_two_phases(m) && !m.t_melt)
    in.refuse(
        m.solid_conductivity ? "solid_conductivity" : "solid_heat_capacity",
        "without t_melt the material has one phase: give t_melt too, or write the value without solid_");
  if (has_two_phases(m) && m.t_solid && latent_heat_at(m, *m.t_solid) < 0.0)
    in.refuse(
        "solid_heat_capacity",
        fmt::format(
            "freezing at t_solid = {} K would take up heat, {:.4g} J/kg: the heat of fusion changes with "
            "temperature as the heat capacities differ; raise latent_heat or t_solid",
            *m.t_solid, -latent_heat_at(m, *m.t_solid)));
}

}  // namespace

/// As printed it divides by sums of density.
EffectRule rule() {
  return {.name = "heat",
          .called_for = called_for,
          .left_out = left_out,
          .terms = {{term::heat, {{"conservative", "equal and opposite in each pair, two stages (8.6)"}}}},
          .terms_shared = {term::kernel, term::pressure, term::density, term::state, term::clamp,
                           term::viscosity, term::walls},
          .choices = {{"heat_surface",
                       {{"exchange",
                         "a held surface exchanges heat where it lies (8.6)",
                         {{"surface_exchange", 1.0}}},
                        {"held", "its outermost particles are held", {{"surface_exchange", 0.0}}}},
                       "surfaces exchange heat where they lie"}},
          .keys = keys(),
          .settle_material = settle_material,
          .ledger_entries = {{"thermal", "heat"}, {"latent", "heat of fusion"}},
          .over_processes = true,
          .has_pairs = true};
}

}  // namespace tripoint::heat
