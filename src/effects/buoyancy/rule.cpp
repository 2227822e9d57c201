// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::buoyancy {
namespace {

bool rises(const Scene& s, const Body& b, const Material& m) {
  return expands(m) && b.phase == Phase::liquid && has_heat(b, m) && norm(s.gravity) > 0.0;
}

std::string called_for(const Scene& s) {
  if (equal_temperature(s)) return "";
  return because(bodies_where(s, rises), "it expands with temperature, under gravity");
}

std::string left_out(const Scene& s) {
  if (!any_material(s, expands)) return "no material has a thermal_expansion";
  if (!(norm(s.gravity) > 0.0)) return "there is no gravity";
  return "no liquid of a material with thermal_expansion has temperatures that differ";
}

std::vector<EffectKey> keys() {
  using enum ValueType;
  return {{{"material", "thermal_expansion", number, "1/K", Range::any, "0",
            "size does not depend on temperature", "",
            "of a liquid: relative loss of density per kelvin, in its weight alone (model 8.13). Of an "
            "elastic solid: "
            "relative gain of length per kelvin"}},
          {{"material", "expansion_temperature", number, "K", Range::not_negative, "0",
            "mean of its matter at the start", "",
            "temperature at which the material has its density and its length; 0: the mean at the start"}}};
}

}  // namespace

EffectRule rule() {
  return {.name = "buoyancy",
          .called_for = called_for,
          .left_out = left_out,
          .keys = keys(),
          .ledger_entries = {{"buoyancy", "minus the work that thermal buoyancy did"}},
          .over_processes = true};
}

}  // namespace tripoint::buoyancy
