// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::viscosity {
namespace {

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") ? "what flows or touches can be viscous" : "";
}

std::string left_out(const Scene& s) { return liquid::why_none_summed(s); }

std::string no_form_of_viscosity(const Scene& s) {
  return s.mode_of(term::viscosity) == Mode::paper ? "viscosity as printed has one form" : "";
}

std::string solid_viscosity_idle(const Scene& scene) {
  return scene.mode_of(term::viscosity) == Mode::paper ? ""
                                                       : "viscosity is corrected: a liquid takes its own "
                                                         "beside a solid, and solids scene.contact_viscosity";
}

std::string no_isotropic_shear(const Scene& s) {
  if (s.mode_of(term::viscosity) == Mode::paper) return "viscosity is as printed";
  if (s.viscosity_form != ViscosityForm::central) return "the viscosity is not central";
  if (s.contact_viscosity > 0.0) return "";
  return any_material(s, [](const Material& m) { return m.viscosity > 0.0; }) ? "" : "nothing is viscous";
}

/// How liquids resist shear (model 8.5).
std::vector<EffectKey> viscosity_keys() {
  using enum Range;
  Key form = old_key("viscosity_form", any, "\"central\"", "corrected viscosity");
  form.type = ValueType::word;
  form.words = "laplacian central";
  return {
      {form, &Scene::viscosity_form, no_form_of_viscosity},
      {old_key("isotropic_shear", fraction, "0",
               "fraction of the weights that make the lattice's resistance to shear isotropic (model 8.5)"),
       {},
       no_isotropic_shear},
  };
}

/// Friction of solids that touch.
std::vector<EffectKey> contact_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "contact_viscosity", number, "Pa s", not_negative, "0", "contact of solids without friction",
        "", "viscosity between solids that touch"},
       &Scene::contact_viscosity},
  };
}

/// Keys of a material.
std::vector<EffectKey> material_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "solid_viscosity", number, "Pa s", not_negative, "0",
        "a solid has scene.contact_viscosity", "",
        "dynamic viscosity of the solid in (8), only where model.viscosity is paper. With model.phase paper "
        "it goes linearly to "
        "viscosity between t_solid and t_melt (Fig. 5)"},
       {},
       solid_viscosity_idle},
      {{"material", "viscosity", number, "Pa s", not_negative, "0", "inviscid", "",
        "dynamic viscosity of the liquid"},
       &Material::viscosity},
  };
}

/// Keys of the case file, in the order of its reference page.
std::vector<EffectKey> keys() {
  std::vector<EffectKey> all;
  for (const auto& group : {viscosity_keys(), contact_keys(), material_keys()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

/// The words of `viscosity_form`, by their places.
constexpr double laplacian = 0.0, central = 1.0;

/// In the order that jobs have had from the start.
std::vector<DeclaredTerm> terms() {
  return {{term::viscosity,
           {{"central",
             "along the line of centres (8.5)",
             {{"viscosity_form", central}, {"isotropic_shear", 0.0}}},
            {"isotropic",
             "central, alike along axes and diagonals",
             {{"viscosity_form", central}, {"isotropic_shear", 1.0}}},
            {"morris",
             "along the difference of velocities, for wall-bounded shear",
             {{"viscosity_form", laplacian}}}}},
          {term::walls, {{"mirrored", "mirrored velocities, and pressure of patches of the face (8.4)"}}}};
}

std::vector<std::string_view> always_reported(const Scene&) { return {"viscous"}; }

}  // namespace

EffectRule rule() {
  return {.name = "viscosity",
          .called_for = called_for,
          .left_out = left_out,
          .terms = terms(),
          .terms_shared = {term::kernel},
          .keys = keys(),
          .ledger_entries = {{"viscous", "work that viscosity took"}},
          .always_reported = always_reported,
          .over_processes = true};
}

}  // namespace tripoint::viscosity
