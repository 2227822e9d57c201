// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::transport {
namespace {

constexpr const char* own_velocity = "particles move with their own velocity";

std::string no_transport_velocity(const Scene& s) {
  if (liquid::carries_density(s)) return "liquid that carries its density has a shift of its own";
  return s.mode_of(term::pressure) == Mode::paper ? "pressure as printed knows no transport velocity" : "";
}

std::string no_transport(const Scene& scene) {
  const std::string printed = printed_among(scene, {term::density, term::pressure, term::state});
  if (!printed.empty()) return printed;
  if (liquid::carries_density(scene)) return "liquids carry their density";
  return scene.transport_velocity ? "" : own_velocity;
}

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && s.transport_velocity && no_transport_velocity(s).empty()
             ? "the transport velocity moves the liquid"
             : "";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  return s.transport_velocity ? no_transport_velocity(s) : own_velocity;
}

std::vector<EffectKey> keys() {
  using enum Range;
  Key moves = old_key("transport_velocity", any, "false", "move particles by the transport velocity");
  moves.type = ValueType::flag;
  return {
      {moves, &Scene::transport_velocity, no_transport_velocity},
      {old_key("mean_pressure", fraction, "0",
               "fraction of the neighbours' mean in the pressure of a liquid (model 8.3)"),
       {},
       no_transport},
      {old_key("sound_damping", not_negative, "0",
               "numerical bulk viscosity over rho0 c h, h the support (model 8.3)"),
       {},
       no_transport},
  };
}

std::vector<ModelChoice> choices() {
  return {{"transport",
           {{"background",
             "a background pressure moves the particles of vortical flow without free surface (8.3)",
             {{"transport_velocity", 1.0}}},
            {"none", "", {{"transport_velocity", 0.0}}}},
           own_velocity},
          {"mean_pressure",
           {{"neighbours",
             "the pressure of a liquid that the transport velocity moves is the mean over neighbours (8.3)",
             {{"mean_pressure", 1.0}}},
            {"none", "", {{"mean_pressure", 0.0}}}},
           "pressure is that of each particle's own density"},
          {"sound_damping",
           {{"bulk",
             "numerical bulk viscosity where the transport velocity moves the liquid (8.3)",
             {{"sound_damping", 0.2}}},
            {"none", "", {{"sound_damping", 0.0}}}},
           "unclamped liquids are often used to study sound waves"}};
}

}  // namespace

EffectRule rule() {
  return {.name = "transport",
          .called_for = called_for,
          .left_out = left_out,
          .choices = choices(),
          .keys = keys(),
          .ledger_entries = {{"transport", "work of the transport velocity"}},
          .over_processes = true};
}

}  // namespace tripoint::transport
