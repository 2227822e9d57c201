// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::plastic {
namespace {

bool has_limit(const Material& m) { return m.elastic_limit.has_value(); }

std::string called_for(const Scene& s) {
  const std::string who = bodies_where(s, [](const Scene& scene, const Body& b, const Material& m) { return b.phase == Phase::elastic && moves(scene, b) && has_limit(m); });
  if (!who.empty()) return because(who, "elastic with an elastic_limit: can yield");
  return because(who_freezes_elastic(s, has_limit), "what freezes can yield");
}

std::string left_out(const Scene& s) {
  if (!any_material(s, has_limit)) return "no material has an elastic_limit";
  const bool elastic = any_body(s, [](const Scene&, const Body& b, const Material&) { return b.phase == Phase::elastic; });
  return elastic ? "the bodies that have a limit are held in place, or not elastic" : "nothing is elastic";
}

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "elastic_limit", number, "", positive, "", "never yields", "", "deviatoric strain where plastic flow begins"}, &Material::elastic_limit},
      {{"material", "plastic_limit", number, "", positive, "", "flows without end", "", "largest plastic strain"}, &Material::plastic_limit},
  };
}

}  // namespace

EffectRule rule() { return {"plastic", called_for, left_out, nullptr, {}, {}, keys()}; }

}  // namespace tripoint::plastic
