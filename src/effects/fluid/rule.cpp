// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "effects/fluid/pressing_gravity.hpp"
#include "effects/fluid/stored_compression.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::fluid {
namespace {

bool is_liquid(const Scene&, const Body& b, const Material&) { return b.phase == Phase::liquid; }

bool is_free_solid(const Scene&, const Body& b, const Material&) { return b.phase != Phase::liquid && b.motion == Motion::free; }

bool has_stiffness(const Material& m) { return m.stiffness.has_value(); }

bool can_break(const Scene&, const Body& b, const Material& m) {
  return b.phase == Phase::elastic && (m.fracture_stretch || m.fracture_distance);
}

/// Bodies that can meet others: contact needs a stiffness, two bodies, or one that can break in two, and one of them free.
std::string who_can_touch(const Scene& s) {
  const bool any_free = std::ranges::any_of(s.bodies, [](const Body& b) { return b.motion == Motion::free; });
  if (!s.contact || !any_material(s, has_stiffness) || !any_free || (s.bodies.size() < 2 && !any_body(s, can_break))) return "";
  return bodies_where(s, [](const Scene&, const Body&, const Material&) { return true; });
}

std::string called_for(const Scene& s) {
  std::string liquid = bodies_where(
      s, [](const Scene& scene, const Body& b, const Material&) { return b.phase == Phase::liquid && moves(scene, b); });
  if (liquid.empty() && !s.inflows.empty()) liquid = "an inflow";
  if (!liquid.empty()) return because(liquid, "liquid, and not held in place");
  if (const std::string touch = who_can_touch(s); !touch.empty())
    return because(touch, "more than one body, one of them free, and a stiffness: they can touch");
  const bool flows = any_material(s, has_stiffness) || s.gravity != Vec3{};
  return flows ? because(who_changes_phase(s), "what melts flows") : "";
}

std::string left_out(const Scene& s) {
  if (any_body(s, is_liquid)) return "every liquid is held in place, and nothing can touch";
  if (!s.contact) return "nothing is liquid, and the scene says contact = \"none\"";
  if (!any_material(s, has_stiffness))
    return "nothing is liquid, no two bodies can meet before the end of the run, and no material has a stiffness";
  return "nothing is liquid, and no free body has another to touch";
}

std::string no_form_of_viscosity(const Scene& s) {
  return s.mode_of(term::viscosity) == Mode::paper ? "viscosity as printed has one form" : "";
}

std::string no_transport_velocity(const Scene& s) {
  return s.mode_of(term::pressure) == Mode::paper ? "pressure as printed knows no transport velocity" : "";
}

std::string solid_viscosity_idle(const Scene& scene) {
  return scene.mode_of(term::viscosity) == Mode::paper
             ? ""
             : "viscosity is corrected: a liquid takes its own beside a solid, and solids scene.contact_viscosity";
}

/// Why liquids can have no numerical bulk viscosity. Reasons: nothing is liquid; something freezes, which changes densities at
/// once; density, pressure or state are printed. Or the scene does not clamp, so that it can have no free surface or contact.
std::string no_bulk_viscosity(const Scene& scene) {
  if (scene.inflows.empty() && !any_body(scene, is_liquid)) return "nothing is liquid";
  if (calls_for(scene, "phase")) return "where matter melts or freezes, densities change at once";
  for (const Term& one : {term::density, term::pressure, term::state})
    if (scene.mode_of(one) != Mode::corrected) return fmt::format("{} is as printed", one.name);
  return scene.clamps() ? "" : "the scene does not clamp";
}

/// Why the topmost layer of a liquid can bear no part of its own weight. The reasons are those of the numerical bulk viscosity,
/// or there is no gravity. Or a free body floats at the surface and loads it by an unknown weight.
std::string no_surface_weight(const Scene& scene) {
  if (any_body(scene,
               [](const Scene&, const Body& b, const Material&) { return b.phase != Phase::liquid && b.motion == Motion::free; }))
    return "a free body that floats would be lifted by it";
  if (pressing_gravity(scene) == Vec3{})
    return "gravity presses nothing down: there is none, or it acts along periodic directions alone";
  return no_bulk_viscosity(scene);
}

std::string no_interface_weight(const Scene& scene) {
  if (pressing_gravity(scene) == Vec3{}) return "gravity presses nothing down";
  std::vector<double> densities;
  for (const Body& b : scene.bodies)
    if (b.phase == Phase::liquid) densities.push_back(scene.material(b.material).density);
  for (const Inflow& f : scene.inflows) densities.push_back(scene.material(f.material).density);
  if (std::ranges::all_of(densities, [&](double rho) { return rho == densities.front(); })) return "all liquids are as heavy";
  return no_bulk_viscosity(scene);
}

std::string no_isotropic_shear(const Scene& s) {
  if (s.mode_of(term::viscosity) == Mode::paper) return "viscosity is as printed";
  if (s.viscosity_form != ViscosityForm::central) return "the viscosity is not central";
  if (s.contact_viscosity > 0.0) return "";
  return any_material(s, [](const Material& m) { return m.viscosity > 0.0; }) ? "" : "nothing is viscous";
}

std::string no_transport(const Scene& scene) {
  for (const Term& one : {term::density, term::pressure, term::state})
    if (scene.mode_of(one) != Mode::corrected) return fmt::format("{} is as printed", one.name);
  return scene.transport_velocity ? "" : "particles move with their own velocity: transport_velocity is false";
}

std::string no_core(const Scene& scene) {
  return scene.mode_of(term::pressure) == Mode::paper ? "the pressure is as printed, and has no core" : "";
}

std::string no_contact_stiffness(const Scene& s) {
  if (s.mode_of(term::state) == Mode::paper) return "the equation of state is as printed";
  if (calls_for(s, "phase")) return "where matter melts or freezes, its stiffness would change at once";
  return any_body(s, is_free_solid) ? "" : "no solid is free to touch another";
}

std::string no_contact_step(const Scene& s) {
  if (s.time_step) return "the scene gives its time_step";
  if (!s.clamps()) return "the scene does not clamp: solids pull at each other before they touch";
  for (const Term& one : {term::density, term::pressure, term::state})
    if (s.mode_of(one) != Mode::corrected) return fmt::format("{} is as printed", one.name);
  if (calls_for(s, "phase")) return "where matter melts or freezes, densities change at once";
  return any_body(s, is_free_solid) ? "" : "no solid is free to touch another";
}

std::string no_face_pressure(const Scene& s) {
  for (const Term term : {term::density, term::pressure, term::state, term::elastic})
    if (s.mode_of(term) != Mode::corrected) return fmt::format("{} is as printed", term.name);
  if (!calls_for(s, "elastic")) return "nothing elastic moves";
  if (calls_for(s, "phase")) return "where matter melts or freezes, its shape of reference changes at once";
  return calls_for(s, "fracture") ? "where bonds break, the shape of reference changes at once" : "";
}

/// How liquids resist shear (model 8.5).
std::vector<EffectKey> viscosity_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "viscosity_form", word, "", any, "\"central\"",
        "keeps angular momentum; right wherever a surface or body is free", "laplacian central",
        "corrected viscosity; laplacian for wall-bounded shear only"},
       &Scene::viscosity_form,
       no_form_of_viscosity},
      {{"scene", "isotropic_shear", number, "", fraction, "0", "most flows soon leave the lattice of the start", "",
        "share of the weights that make the lattice's resistance to shear isotropic (model 8.5). Only where viscosity is "
        "corrected and central"},
       {},
       no_isotropic_shear},
  };
}

/// Motion by the transport velocity, and what goes with it (model 8.3).
std::vector<EffectKey> transport_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "transport_velocity", flag, "", any, "false", "a choice for vortical flow without free surface", "",
        "move particles by the transport velocity"},
       &Scene::transport_velocity,
       no_transport_velocity},
      {{"scene", "mean_pressure", number, "", fraction, "0", "pressure is that of each particle's own density", "",
        "share of the neighbours' mean in the pressure of a liquid (model 8.3). Only with transport_velocity, where density, "
        "pressure and state are corrected"},
       {},
       no_transport},
      {{"scene", "sound_damping", number, "", not_negative, "0", "off: unclamped liquids are often used to study sound waves", "",
        "numerical bulk viscosity over rho0 c h, h the support (model 8.3). Only with transport_velocity, where density, "
        "pressure and state are corrected"},
       {},
       no_transport},
  };
}

/// Forces of solids on each other and on liquids where they touch (model 8.3).
std::vector<EffectKey> contact_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "contact_viscosity", number, "Pa s", not_negative, "0", "contact of solids without friction", "",
        "viscosity between solids that touch"},
       &Scene::contact_viscosity},
      {{"scene", "contact_stiffness", number, "", not_negative, "0", "contacts are as stiff as the scene's liquids", "",
        "extra stiffness of solid contact: contacts use (1 + contact_stiffness) k (model 8.3). Only where the state is "
        "corrected, nothing freezes, and a solid is free"},
       {},
       no_contact_stiffness},
      {{"scene", "contact_step", number, "", fraction, "0", "the contact bound always holds", "",
        "share of the contact bound of the step, used only while a free solid is pressed or about to be (model 8.10). 0: the "
        "bound always holds. Only where the scene clamps without time_step, density, pressure and state are corrected, nothing "
        "freezes, and a solid is free"},
       {},
       no_contact_step},
      {{"scene", "face_pressure", number, "", fraction, "0", "bodies of many particles hardly need it", "",
        "share of the pressure on an elastic solid that acts at its face, not at its outer particles (model 8.3). Only where "
        "density, pressure, state and elasticity are corrected, nothing freezes and no solid can break"},
       {},
       no_face_pressure},
  };
}

/// Keys of the terms beside the equation of state of liquids (model 8.3, 8.4).
std::vector<EffectKey> pressure_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "bulk_viscosity", number, "", not_negative, "0.2", "damps the sound that a liquid's start emits", "",
        "numerical bulk viscosity of liquids over rho0 c h, h the support (model 8.4); 0: none. Only where the scene clamps, "
        "density, pressure and state are corrected, and nothing freezes"},
       {},
       no_bulk_viscosity},
      {{"scene", "core_reach", number, "", fraction, "0.9", "keeps pairs apart where the clamp leaves no pressure", "",
        "distance in spacings below which pressing pairs repel (model 8.3); 0: none. Only where the "
        "pressure is corrected"},
       {},
       no_core},
      {{"scene", "surface_weight", number, "", not_negative, "0.5", "half of its own weight lies above the middle of a layer", "",
        "share of its weight that the topmost layer of a liquid bears as pressure (model 8.3); 0: none. Only where the scene "
        "clamps, density, pressure and state are corrected, nothing freezes, and no body is free"},
       {},
       no_surface_weight},
      {{"scene", "interface_weight", number, "", fraction, "0", "only layers of two liquids need it", "",
        "share of the energy of unlike pairs that corrects the pressure at a level interface of two liquids (model 8.3). Only "
        "where density, pressure and state are corrected, the scene clamps, nothing freezes, and "
        "liquids of two densities have a weight"},
       {},
       no_interface_weight},
  };
}

/// Keys of a material.
std::vector<EffectKey> material_keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "stiffness", number, "m2/s2", positive, "", "from the speeds of the scene or elastic moduli", "",
        "k of p = k (rho - rho0), the square of the sound speed"},
       &Material::stiffness},
      {{"material", "sound_speed", number, "m/s", positive, "", "see stiffness", "", "instead of stiffness: k is its square"},
       EffectKey::ByRule{}},
      {{"material", "solid_viscosity", number, "Pa s", not_negative, "0", "a solid has scene.contact_viscosity", "",
        "dynamic viscosity of the solid in (8), only where modes.viscosity is paper. With modes.phase paper it goes linearly to "
        "viscosity between t_solid and t_melt (Fig. 5)"},
       {},
       solid_viscosity_idle},
      {{"material", "viscosity", number, "Pa s", not_negative, "0", "inviscid", "", "dynamic viscosity of the liquid"},
       &Material::viscosity},
  };
}

/// Keys of the case file, in the order of its reference page.
std::vector<EffectKey> keys() {
  std::vector<EffectKey> all;
  for (const auto& group : {viscosity_keys(), transport_keys(), contact_keys(), pressure_keys(), material_keys()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

/// The words of `viscosity_form`, by their places.
constexpr double laplacian = 0.0, central = 1.0;

std::vector<DeclaredTerm> terms() {
  return {{term::pressure, {{"conservative", "the gradient of an energy of compression (8.3)"}}},
          {term::density, {{"number", "number density over its lattice sum (8.2)"}}},
          {term::state, {{"scaled", "all liquids equally hard to compress (8.3)"}}},
          {term::clamp, {{"clamped", "no pressure below zero"}}, TermKind::law, false},
          {term::viscosity,
           {{"central", "along the line of centres (8.5)", {{"viscosity_form", central}, {"isotropic_shear", 0.0}}},
            {"isotropic", "central, alike along axes and diagonals", {{"viscosity_form", central}, {"isotropic_shear", 1.0}}},
            {"morris", "along the difference of velocities, for wall-bounded shear", {{"viscosity_form", laplacian}}}}},
          {term::walls, {{"mirrored", "mirrored velocities, and pressure of patches of the face (8.4)"}}}};
}

std::vector<ModelChoice> choices() {
  return {{"mean_pressure",
           {{"neighbours",
             "the pressure of a liquid that the transport velocity moves is the mean over neighbours (8.3)",
             {{"mean_pressure", 1.0}}},
            {"none", "", {{"mean_pressure", 0.0}}}}},
          {"sound_damping",
           {{"bulk", "numerical bulk viscosity where the transport velocity moves the liquid (8.3)", {{"sound_damping", 0.2}}},
            {"none", "", {{"sound_damping", 0.0}}}}},
          {"contact",
           {{"stiff", "solids are 25 times as stiff where they touch (8.3)", {{"contact_stiffness", 24.0}}},
            {"common", "as stiff as the scene's liquids", {{"contact_stiffness", 0.0}}}}},
          {"contact_step",
           {{"at-touch", "the bound of contact holds near a touch alone (8.10)", {{"contact_step", 1.0}}},
            {"always", "it holds in every step", {{"contact_step", 0.0}}}}},
          {"contact_face",
           {{"face", "pressure acts at the faces of elastic solids (8.3)", {{"face_pressure", 1.0}}},
            {"centres", "at the middles of their outer particles", {{"face_pressure", 0.0}}}}},
          {"bulk_viscosity",
           {{"numerical", "of liquids, 0.2 rho0 c h (8.4)", {{"bulk_viscosity", 0.2}}}, {"none", "", {{"bulk_viscosity", 0.0}}}}},
          {"core",
           {{"repulsive", "pairs repel below 0.9 spacings (8.3)", {{"core_reach", 0.9}}}, {"none", "", {{"core_reach", 0.0}}}}},
          {"surface",
           {{"weighted", "the topmost layer bears half of its weight (8.3)", {{"surface_weight", 0.5}}},
            {"none", "", {{"surface_weight", 0.0}}}}},
          {"interface",
           {{"weighted", "pressure is right on both sides of a level interface (8.3)", {{"interface_weight", 1.0}}},
            {"none", "", {{"interface_weight", 0.0}}}}}};
}

void settle_material(TableReader& in, Material& m) {
  const auto c = in.maybe_number("sound_speed");
  if (!c) return;
  if (in.has("stiffness")) in.refuse("sound_speed", "stiffness is given too, and is its square: give one of them");
  m.stiffness = *c * *c;
  in.ruled("stiffness", show(*m.stiffness), "the square of sound_speed");
}

std::vector<std::string_view> always_told(const Scene& scene) {
  return {"viscous", stores_compression(scene) ? "compression" : "pressure_work"};
}

}  // namespace

EffectRule rule() {
  return {.name = "fluid",
          .called_for = called_for,
          .left_out = left_out,
          .terms = terms(),
          .terms_shared = {term::kernel},
          .choices = choices(),
          .keys = keys(),
          .scene_keys = {{"clamp"}},
          .settle_material = settle_material,
          .ledger_entries = {{"compression", "liquid that is compressed, where its pressure has an energy"},
                             {"pressure_work", "in place of `compression`: work that the printed form of pressure took"},
                             {"phase_work"},
                             {"viscous", "work that viscosity took"},
                             {"bulk_viscous", "work that the numerical bulk viscosity took"},
                             {"transport", "work of the transport velocity"}},
          .always_told = always_told,
          .over_processes = true,
          .has_pairs = true,
          .has_pressure = true};
}

}  // namespace tripoint::fluid
