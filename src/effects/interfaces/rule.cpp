// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "liquids/carried_density.hpp"
#include "liquids/compression_energy.hpp"
#include "liquids/pressing_gravity.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::interfaces {
namespace {

std::string no_interface_weight(const Scene& scene) {
  if (liquid::pressing_gravity(scene) == Vec3{}) return "gravity presses nothing down";
  std::vector<double> densities;
  for (const Body& b : scene.bodies)
    if (b.phase == Phase::liquid) densities.push_back(scene.material(b.material).density);
  for (const Inflow& f : scene.inflows) densities.push_back(scene.material(f.material).density);
  if (std::ranges::all_of(densities, [&](double rho) { return rho == densities.front(); }))
    return "all liquids are as heavy";
  return liquid::no_compression_energy(scene);
}

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && acting_number(s, "interface_weight") > 0.0
             ? "liquids of two densities have a weight"
             : "";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  const std::string why = no_interface_weight(s);
  return why.empty() ? "the scene asks for no right pressure at an interface" : why;
}

std::vector<EffectKey> keys() {
  return {
      {old_key("interface_weight", Range::fraction, "0",
               "fraction of the energy of unlike pairs at an interface (model 8.3)"),
       {},
       no_interface_weight},
  };
}

}  // namespace

EffectRule rule() {
  return {.name = "interfaces",
          .called_for = called_for,
          .left_out = left_out,
          .choices = {{"interface",
                       {{"weighted",
                         "pressure is right on both sides of a level interface (8.3)",
                         {{"interface_weight", 1.0}}},
                        {"none", "", {{"interface_weight", 0.0}}}},
                       "only layers of two liquids need it"}},
          .keys = keys(),
          .over_processes = true};
}

}  // namespace tripoint::interfaces
