// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::elastic {
namespace {

std::string called_for(const Scene& s) {
  const std::string who = bodies_where(s, [](const Scene& scene, const Body& b, const Material&) {
    return b.phase == Phase::elastic && moves(scene, b);
  });
  if (!who.empty()) return because(who, "elastic, and not held in place");
  return because(who_freezes_elastic(s, [](const Material&) { return true; }), "what freezes is elastic");
}

std::string left_out(const Scene& s) {
  return any_body(s, [](const Scene&, const Body& b, const Material&) { return b.phase == Phase::elastic; })
             ? "what is elastic is held in place"
             : "nothing is elastic";
}

std::string no_bending(const Scene& s) {
  return s.mode_of(term::elastic) == Mode::paper ? "elasticity as printed has no second-order gradients" : "";
}

std::string no_hourglass(const Scene& s) {
  const bool printed = s.mode_of(term::hourglass) == Mode::paper || s.mode_of(term::elastic) == Mode::paper;
  return printed ? "elasticity as printed has no energy against zero-energy modes" : "";
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  static const std::string papers_support = fmt::format("{}", printed_support);
  return {
      {old_key("hourglass", not_negative, "1", "coefficient of the energy against zero-energy modes"),
       {},
       no_hourglass},
      {old_key("bond_reach", above_one, papers_support,
               "reach of bonds and support of the kernel (17), in spacings")},
      {old_key("bending", fraction, "1", "fraction of the bending correction (model 8.7)"), {}, no_bending},
      {{"material", "young_modulus", number, "Pa", positive, "", "not elastic", "", "E of the solid"},
       &Material::young_modulus},
      {{"material", "poisson_ratio", number, "", poisson, "", "not elastic", "", "of the solid, below 0.5"},
       &Material::poisson_ratio},
  };
}

std::vector<DeclaredTerm> terms() {
  DeclaredTerm elasticity{
      term::elastic,
      {{"second-order", "gradients at surfaces exact for curved displacements too (8.7)", {{"bending", 1.0}}},
       {"first-order", "exact for linear ones", {{"bending", 0.0}}}}};
  elasticity.name = "elasticity";
  return {elasticity,
          {term::hourglass, {{"energy", "energy against modes without energy (8.7)", {{"hourglass", 1.0}}}}}};
}

void settle_material(TableReader& in, Material& m) {
  if (m.young_modulus.has_value() != m.poisson_ratio.has_value())
    in.refuse(m.young_modulus ? "young_modulus" : "poisson_ratio",
              "an elastic material needs both young_modulus and poisson_ratio: give the other too");
}

}  // namespace

EffectRule rule() {
  return {.name = "elastic",
          .called_for = called_for,
          .left_out = left_out,
          .terms = terms(),
          .keys = keys(),
          .settle_material = settle_material,
          .ledger_entries = {{"elastic", "strain of elastic matter"},
                             {"hourglass", "deformation that the strain does not see"}},
          .over_processes = true,
          .has_pairs = true,
          .has_bonds = true,
          .deforms_bodies = true};
}

}  // namespace tripoint::elastic
