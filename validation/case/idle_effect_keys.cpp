// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "scene/effect_rule.hpp"
#include "scene/model.hpp"
#include "scene/scene_keys.hpp"
#include "validation/case/idle_search.hpp"

/// Keys of materials and of the scene that no effect of it reads.
namespace tripoint {
namespace {

/// Whether an effect of the case reads a key that another one brings.
bool is_shared(const IdleSearch& in, std::string_view key) {
  return std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
    return std::ranges::find(rule.scene_keys_shared, key) != rule.scene_keys_shared.end() &&
           in.calls(rule.name);
  });
}

void material_key(IdleSearch& in, const Material& m, const EffectRule& rule, const EffectKey& key) {
  const auto place = in.given(fmt::format("material.{}.{}", m.name, key.row.name));
  if (place.file.empty()) return;
  if (is_shared(in, key.row.name)) return;
  const bool on = in.calls(rule.name);
  if (on && (!key.idle || in.any_mode([&](const Scene& run) { return key.idle(run).empty(); }))) return;
  in.warn(place, fmt::format("{} of material \"{}\" never acts: {}", key.row.name, m.name,
                             on ? key.idle(in.scenes.front()) : in.why_idle(rule.name)));
}

void material(IdleSearch& in, const Material& m) {
  const auto is_of = [&](const auto& user) { return user.material == m.name; };
  const bool used =
      std::ranges::any_of(in.scene.bodies, is_of) || std::ranges::any_of(in.scene.inflows, is_of);
  if (!used)
    return in.warn(
        in.given("material." + m.name + ".name"),
        fmt::format("no body and no inflow is of material \"{}\": name it in one, or remove it", m.name));
  const std::string path = "material." + m.name + ".";
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys)
      if (key.row.table == "material" && (key.limit || value_of(m.values, key.row.name) != 0.0))
        material_key(in, m, rule, key);
  for (const EffectRule& rule : effect_rules())
    if (rule.wrong_keys && in.calls(rule.name))
      for (const WrongKey& wrong : rule.wrong_keys(m, in.scenes))
        in.error(in.given(path + std::string(wrong.key)), wrong.why);
}

void idle(IdleSearch& in, std::string_view key, const std::string& why) {
  if (const auto place = in.given(fmt::format("scene.{}", key)); !place.file.empty())
    in.warn(place, fmt::format("scene.{} changes nothing: {}; remove it", key, why));
}

/// Whether the scene wants what the key stands for: else there is nothing to miss. A number that is not 0 by
/// default may be 0.
bool asks(const Scene& s, const EffectKey& key) {
  const auto kept = [&](const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, std::monostate>)
      return kept_number(s.values, key.row) != 0.0 || kept_number({}, key.row) != 0.0;
    else if constexpr (requires { s.*member; })
      return s.*member != Scene{}.*member;
    else
      return false;
  };
  return std::visit(kept, key.kept_in);
}

void effect_key(IdleSearch& in, const EffectRule& rule, const EffectKey& key) {
  if (!in.calls(rule.name))
    idle(in, key.row.name, in.why_idle(rule.name));
  else if (key.idle && !in.any_mode([&](const Scene& run) { return key.idle(run).empty(); }))
    idle(in, key.row.name, key.idle(in.scenes.front()));
}

bool acts(const IdleSearch& in, const Term& one) {
  return acts_everywhere(one) || std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
           return reads_term(rule, one) && in.calls(rule.name);
         });
}

/// Whether an effect of the case reads this key of the scene, or something beside its effects.
bool is_read(const IdleSearch& in, const SceneKey& key) {
  return (key.serves && in.any_mode(key.serves)) || is_shared(in, key.name);
}

/// Words of [model] for what is in no run of the case.
void model(IdleSearch& in) {
  for (const ModelTerm& t : model_terms()) {
    const auto place = in.given(fmt::format("model.{}", t.name));
    const ModelForm* form = form_in(in.scenes.front(), t);
    if (place.file.empty() || !t.rule || !form) continue;
    const auto idle = [&](const Scene& run) { return why_idle(run, t, *form); };
    const bool is_on = t.term ? acts(in, *t.term) : in.calls(t.rule->name);
    if (is_on && in.any_mode([&](const Scene& run) { return idle(run).empty(); })) continue;
    in.warn(place, fmt::format("model.{} changes nothing: {}; remove it", t.name,
                               is_on ? idle(in.scenes.front()) : in.why_idle(t.rule->name)));
  }
}

void scene_keys(IdleSearch& in) {
  const Scene& s = in.value.scene;
  for (const EffectRule& rule : effect_rules()) {
    for (const SceneKey& key : rule.scene_keys)
      if (!in.calls(rule.name) && !is_read(in, key)) idle(in, key.name, in.why_idle(rule.name));
    for (const EffectKey& key : rule.keys)
      if (key.row.table == "scene" && asks(s, key)) effect_key(in, rule, key);
  }
  model(in);
  for (const DeclaredTerm& one : declared_terms())
    if (const auto given = s.modes_given.find(one.term);
        given != s.modes_given.end() && given->second != s.mode && !acts(in, one.term))
      idle(in, fmt::format("modes.{}", one.term.name), "no effect of this scene has that term");
}

}  // namespace

void find_idle_effect_keys(IdleSearch& in) {
  for (const Material& m : in.scene.materials) material(in, m);
  scene_keys(in);
}

}  // namespace tripoint
