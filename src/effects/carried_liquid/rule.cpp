// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::carried_liquid {

namespace {

/// Whether what melts can be pressed or pulled.
bool flows(const Scene& s) {
  return s.gravity != Vec3{} || any_material(s, [](const Material& m) { return m.stiffness.has_value(); });
}

std::string called_for(const Scene& s) {
  if (!liquid::carries_density(s)) return "";
  std::string who = bodies_where(s, [](const Scene& scene, const Body& b, const Material&) {
    return b.phase == Phase::liquid && moves(scene, b);
  });
  if (who.empty() && !s.inflows.empty()) who = "an inflow";
  if (who.empty() && flows(s)) who = who_changes_phase(s);
  return because(who, "liquid that carries its density");
}

std::string left_out(const Scene&) { return "liquids take their density from the sum over neighbours"; }

std::vector<BroughtForm> forms() {
  const auto form = [](std::string_view word, std::string_view meaning) {
    return BroughtForm{term::pressure, {word, meaning}, word == "adjoint"};
  };
  return {
      form("adjoint",
           "density is carried by a rate exact for linear velocities, and the force is its adjoint"),
      form("adjoint_limited", "the same pair with limited viscosity, and a shift by the flow's own speed"),
      form("reverse", "as adjoint_limited with the matrices of the pair exchanged"),
      form("reverse_riemann", "exchanged matrices, a plain rate, Riemann pairs"),
      form("mean", "as adjoint with the mean of the pair's matrices")};
}

}  // namespace

EffectRule rule() {
  return {.name = "carried_liquid",
          .called_for = called_for,
          .left_out = left_out,
          .terms_shared = {term::pressure, term::density, term::state, term::clamp, term::viscosity},
          .forms = forms(),
          .scene_keys_shared = {"clamp"},
          .ledger_entries = {{"compression"},
                             {"viscous"},
                             {"residue", "work that the viscosity of the residue took"},
                             {"diffusion", "energy that density diffusion and the tie to the sum took"},
                             {"shifting", "energy of places that the shift took"}},
          .over_processes = true,
          .has_pairs = true,
          .has_pressure = true};
}

}  // namespace tripoint::carried_liquid
