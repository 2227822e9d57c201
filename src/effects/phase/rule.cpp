// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::phase {
namespace {

std::string called_for(const Scene& s) {
  return because(who_changes_phase(s), "the scene's temperatures pass t_melt or t_solid of the material");
}

/// The proof that nothing melts or freezes.
std::string left_out(const Scene& s) {
  if (!any_material(s, [](const Material& m) { return m.t_melt.has_value(); })) return "no material has a t_melt";
  const TemperatureRange range = temperatures_of(s);
  if (range.empty()) return "no temperature is given";
  return fmt::format(
      "bodies, inflows and events have {:.6g} to {:.6g} K, conduction never leaves that range, and no solid there melts and no "
      "liquid freezes",
      range.least, range.greatest);
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "t_melt", number, "K", positive, "", "does not melt", "", "above it the matter is liquid"},
       &Material::t_melt},
      {{"material", "t_solid", number, "K", positive, "=", "t_melt: no soft band and no hysteresis", "",
        "below it the matter is solid; at most t_melt"},
       &Material::t_solid},
      {{"material", "latent_heat", number, "J/kg", not_negative, "=", "melts at once where t_melt is given", "",
        "heat of fusion"},
       &Material::latent_heat},
      {{"material", "softens", flag, "", any, "false", "full stiffness up to melting", "",
        "stiffness falls with the liquid fraction; with solid = \"rigid\", a young_modulus and modes.phase = \"paper\": elastic "
        "between t_solid and t_melt, as Fig. 5 prints it"},
       &Material::softens},
  };
}

}  // namespace

EffectRule rule() { return {"phase", called_for, left_out, nullptr, {term::phase}, {}, keys()}; }

}  // namespace tripoint::phase
