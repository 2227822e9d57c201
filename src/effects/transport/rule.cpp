// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::transport {
namespace {

std::string no_transport_velocity(const Scene& s) {
  if (liquid::carries_density(s)) return "liquid that carries its density has a shift of its own";
  return s.mode_of(term::pressure) == Mode::paper ? "pressure as printed knows no transport velocity" : "";
}

std::string no_transport(const Scene& scene) {
  const std::string printed = printed_among(scene, {term::density, term::pressure, term::state});
  if (!printed.empty()) return printed;
  if (liquid::carries_density(scene)) return "liquids carry their density";
  return scene.transport_velocity ? ""
                                  : "particles move with their own velocity: transport_velocity is false";
}

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && s.transport_velocity && no_transport_velocity(s).empty()
             ? "scene.transport_velocity moves the liquid"
             : "";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  return s.transport_velocity ? no_transport_velocity(s) : "scene.transport_velocity is false";
}

std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"scene", "transport_velocity", flag, "", any, "false",
        "a choice for vortical flow without free surface", "", "move particles by the transport velocity"},
       &Scene::transport_velocity,
       no_transport_velocity},
      {{"scene", "mean_pressure", number, "", fraction, "0",
        "pressure is that of each particle's own density", "",
        "fraction of the neighbours' mean in the pressure of a liquid (model 8.3). Only with "
        "transport_velocity, where density, "
        "pressure and state are corrected"},
       {},
       no_transport},
      {{"scene", "sound_damping", number, "", not_negative, "0",
        "off: unclamped liquids are often used to study sound waves", "",
        "numerical bulk viscosity over rho0 c h, h the support (model 8.3). Only with transport_velocity, "
        "where density, "
        "pressure and state are corrected"},
       {},
       no_transport},
  };
}

}  // namespace

EffectRule rule() {
  return {
      .name = "transport",
      .called_for = called_for,
      .left_out = left_out,
      .choices =
          {{"mean_pressure",
            {{"neighbours",
              "the pressure of a liquid that the transport velocity moves is the mean over neighbours (8.3)",
              {{"mean_pressure", 1.0}}},
             {"none", "", {{"mean_pressure", 0.0}}}}},
           {"sound_damping",
            {{"bulk",
              "numerical bulk viscosity where the transport velocity moves the liquid (8.3)",
              {{"sound_damping", 0.2}}},
             {"none", "", {{"sound_damping", 0.0}}}}}},
      .keys = keys(),
      .ledger_entries = {{"transport", "work of the transport velocity"}},
      .over_processes = true};
}

}  // namespace tripoint::transport
