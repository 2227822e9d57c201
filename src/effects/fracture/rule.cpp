// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::fracture {
namespace {

bool has_limit(const Material& m) { return m.fracture_stretch || m.fracture_distance; }

std::string called_for(const Scene& s) {
  const std::string who = bodies_where(s, [](const Scene& scene, const Body& b, const Material& m) { return b.phase == Phase::elastic && moves(scene, b) && has_limit(m); });
  if (!who.empty()) return because(who, "elastic with a fracture limit: can break");
  return because(who_freezes_elastic(s, has_limit), "what freezes can break");
}

std::string left_out(const Scene& s) {
  if (!any_material(s, has_limit)) return "no material has a fracture limit";
  const bool elastic = any_body(s, [](const Scene&, const Body& b, const Material&) { return b.phase == Phase::elastic; });
  return elastic ? "the bodies that have a limit are held in place, or not elastic" : "nothing is elastic";
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "fracture_stretch", number, "", above_one, "", "never breaks", "", "corrected: stretch |r|/|x| that breaks a bond"}, &Material::fracture_stretch},
      {{"material", "fracture_distance", number, "", positive, "", "never breaks", "", "paper: distance that breaks a bond, in spacings"}, &Material::fracture_distance},
  };
}

}  // namespace

EffectRule rule() { return {"fracture", called_for, left_out, nullptr, {}, {}, keys()}; }

}  // namespace tripoint::fracture
