// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::elastic {
namespace {

std::string called_for(const Scene& s) {
  const std::string who = bodies_where(s, [](const Scene& scene, const Body& b, const Material&) { return b.phase == Phase::elastic && moves(scene, b); });
  if (!who.empty()) return because(who, "elastic, and not held in place");
  return because(who_freezes_elastic(s, [](const Material&) { return true; }), "what freezes is elastic");
}

std::string left_out(const Scene& s) {
  return any_body(s, [](const Scene&, const Body& b, const Material&) { return b.phase == Phase::elastic; }) ? "what is elastic is held in place" : "nothing is elastic";
}

}  // namespace

EffectRule rule() { return {"elastic", called_for, left_out, nullptr, {Term::elastic, Term::hourglass}}; }

}  // namespace tripoint::elastic
