// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/shared_terms.hpp"

namespace tripoint {

namespace {

bool acts(const ModelTerm& t, const Scene& scene) {
  if (!t.term) return t.rule && calls_for(scene, t.rule->name);
  const std::vector<Term> acting = acting_terms(scene);
  return std::ranges::find(acting, *t.term) != acting.end();
}

}  // namespace

std::vector<Correction> corrections() {
  std::vector<Correction> list;
  for (const ModelTerm& t : model_terms()) {
    list.push_back({std::string(t.name), &t, &t.forms.back()});
    const ModelForm* usual = form_in(Scene{}, t);
    if (t.forms.size() > 2 && usual && usual != &t.forms.back())
      list.push_back({fmt::format("{}={}", t.name, usual->word), &t, usual});
  }
  return list;
}

bool can_act(const Correction& one, const Scene& scene) {
  const ModelTerm& t = *one.of;
  if (!acts(t, scene) || form_in(scene, t) == one.form) return false;
  const bool is_last = one.form == &t.forms.back();
  if (t.term && is_last) return true;
  if (t.term && scene.mode_of(*t.term) == Mode::paper) return false;
  return why_idle(scene, t, *one.form).empty();
}

Case corrected(Case value) {
  value.modes = {Mode::corrected};
  value.scene.mode = Mode::corrected;
  // A scene with the transport velocity cannot clamp, and would not run with it.
  std::erase_if(value.scene.modes_given, [&](const auto& given) {
    return !(value.scene.transport_velocity && given.first == term::clamp);
  });
  value.studies.clear();
  value.gates.clear();
  value.inputs.clear();
  return value;
}

Case without(const Correction& one, Case value) {
  choose(value.scene, *one.of, *one.form);
  return value;
}

}  // namespace tripoint
