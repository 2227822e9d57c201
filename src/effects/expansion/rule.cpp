// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::expansion {
namespace {

std::string called_for(const Scene& s) {
  const auto stretches = [](const Scene&, const Body& b, const Material& m) {
    return expands(m) && b.phase == Phase::elastic && has_heat(b, m);
  };
  return because(bodies_where(s, stretches), "it is elastic, and expands with temperature");
}

std::string left_out(const Scene& s) {
  return any_material(s, expands) ? "no elastic body of a material with thermal_expansion has a temperature"
                                  : "no material has a thermal_expansion";
}

}  // namespace

EffectRule rule() {
  return {.name = "expansion",
          .called_for = called_for,
          .left_out = left_out,
          .scene_keys_shared = {"thermal_expansion", "expansion_temperature"},
          .ledger_entries = {{"expansion", "elastic energy that thermal expansion took"}},
          .changes_temperatures = true};
}

}  // namespace tripoint::expansion
