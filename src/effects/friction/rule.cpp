// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "liquids/carried_density.hpp"
#include "scene/contact_law.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::friction {
namespace {

std::string called_for(const Scene& s) {
  if (!calls_for(s, "pressure") || !printed_among(s, {term::density, term::pressure, term::state}).empty())
    return "";
  const auto law = std::ranges::find_if(s.contact_laws, takes_energy);
  return law == s.contact_laws.end() ? ""
                                     : "materials " + law->materials[0] + " and " + law->materials[1] +
                                           " rub, or lose energy in hits";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  if (const std::string printed = printed_among(s, {term::density, term::pressure, term::state});
      !printed.empty())
    return printed;
  return "no [[contact]] of two materials states a friction, or a restitution below 1";
}

}  // namespace

EffectRule rule() {
  return {
      .name = "friction",
      .called_for = called_for,
      .left_out = left_out,
      .ledger_entries = {
          {"friction", "energy that friction and hits took, and that springs of sticking particles hold"}}};
}

}  // namespace tripoint::friction
