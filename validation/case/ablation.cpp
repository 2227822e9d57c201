// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/ablation.hpp"

#include <algorithm>

#include "scene/shared_terms.hpp"

namespace tripoint {

std::vector<Correction> corrections() {
  std::vector<Correction> list;
  for (const DeclaredTerm& one : declared_terms()) list.push_back({std::string(one.term.name), one.term});
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys)
      if (key.ablated) list.push_back({std::string(key.row.name), {}, &rule, &key});
  return list;
}

bool can_act(const Correction& one, const Scene& scene) {
  if (!one.term)
    return kept_number(scene.values, one.key->row) != 0.0 && calls_for(scene, one.rule->name) &&
           (!one.key->idle || one.key->idle(scene).empty());
  const std::vector<Term> acting = acting_terms(scene);
  return std::ranges::find(acting, *one.term) != acting.end();
}

Case corrected(Case value) {
  value.modes = {Mode::corrected};
  value.scene.mode = Mode::corrected;
  // A scene with the transport velocity cannot clamp, and would not run with it.
  std::erase_if(value.scene.modes_given,
                [&](const auto& given) { return !(value.scene.transport_velocity && given.first == term::clamp); });
  value.studies.clear();
  value.gates.clear();
  value.inputs.clear();
  return value;
}

Case without(const Correction& one, Case value) {
  if (one.term)
    value.scene.modes_given[*one.term] = Mode::paper;
  else
    value.scene.values[std::string(one.key->row.name)] = 0.0;
  return value;
}

}  // namespace tripoint
