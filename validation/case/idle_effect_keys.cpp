// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "validation/case/idle_search.hpp"

/// Keys of materials and of the scene that no effect of it reads.
namespace tripoint {
namespace {

void material_key(IdleSearch& in, const Material& m, const EffectRule& rule, const EffectKey& key) {
  const auto place = in.given(fmt::format("material.{}.{}", m.name, key.row.name));
  if (place.file.empty()) return;
  const bool on = in.calls(std::string(rule.name));
  if (on && (!key.idle || in.any_mode([&](const Scene& run) { return key.idle(run).empty(); }))) return;
  in.warn(place, fmt::format("{} of material \"{}\" never acts: {}", key.row.name, m.name,
                             on ? key.idle(in.scenes.front()) : in.why_idle(std::string(rule.name))));
}

void material(IdleSearch& in, const Material& m) {
  const auto is_of = [&](const auto& user) { return user.material == m.name; };
  const bool used = std::ranges::any_of(in.scene.bodies, is_of) || std::ranges::any_of(in.scene.inflows, is_of);
  if (!used)
    return in.warn(in.given("material." + m.name + ".name"),
                   fmt::format("no body and no inflow is of material \"{}\": name it in one, or remove it", m.name));
  const std::string path = "material." + m.name + ".";
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys)
      if (key.row.table == "material" && (key.limit || value_of(m.values, key.row.name) != 0.0)) material_key(in, m, rule, key);
  if (!in.calls("fracture")) return;
  const auto elastic_in = [&](Mode mode) {
    return in.any_mode([&](const Scene& s) { return s.mode_of(term::elastic) == mode; });
  };
  const bool printed = elastic_in(Mode::paper), corrected = elastic_in(Mode::corrected);
  if (m.fracture_distance && !m.fracture_stretch && !printed)
    in.error(in.given(path + "fracture_distance"),
             fmt::format("fracture_distance is the limit of the printed form, and this case runs the corrected one, in which "
                         "\"{}\" never breaks: give fracture_stretch",
                         m.name));
  if (m.fracture_stretch && !m.fracture_distance && !corrected)
    in.error(in.given(path + "fracture_stretch"),
             fmt::format("fracture_stretch is the limit of the corrected form, and this case runs the printed one, in which "
                         "\"{}\" never breaks: give fracture_distance",
                         m.name));
}

void idle(IdleSearch& in, const char* key, const std::string& why) {
  if (const auto place = in.given(std::string("scene.") + key); !place.file.empty())
    in.warn(place, fmt::format("scene.{} changes nothing: {}; remove it", key, why));
}

/// Whether the scene wants what the key stands for: else there is nothing to miss. A number that is not 0 by default may be 0.
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
  const auto name = std::string(key.row.name);
  if (!in.calls(std::string(rule.name)))
    idle(in, name.c_str(), in.why_idle(std::string(rule.name)));
  else if (key.idle && !in.any_mode([&](const Scene& run) { return key.idle(run).empty(); }))
    idle(in, name.c_str(), key.idle(in.scenes.front()));
}

bool acts(const IdleSearch& in, const Term& one) {
  return acts_everywhere(one) || std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
           return reads_term(rule, one) && in.calls(std::string(rule.name));
         });
}

void scene_keys(IdleSearch& in) {
  const Scene& s = in.value.scene;
  if (!in.calls("fluid")) idle(in, "clamp", in.why_idle("fluid"));
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys)
      if (key.row.table == "scene" && asks(s, key)) effect_key(in, rule, key);
  const bool breaks_up = in.calls("fracture") || std::ranges::any_of(s.events, [](const Event& e) {
                           return e.kind == Event::Kind::merge || e.kind == Event::Kind::split;
                         });
  if (!in.calls("phase") && !breaks_up && std::ranges::all_of(s.bodies, [](const Body& b) { return b.joined_to.empty(); }))
    idle(in, "merge_distance", in.why_idle("phase"));
  for (const DeclaredTerm& one : declared_terms())
    if (const auto given = s.modes_given.find(one.term);
        given != s.modes_given.end() && given->second != s.mode && !acts(in, one.term))
      idle(in, fmt::format("modes.{}", one.term.name).c_str(), "no effect of this scene has that term");
}

}  // namespace

void find_idle_effect_keys(IdleSearch& in) {
  for (const Material& m : in.scene.materials) material(in, m);
  scene_keys(in);
}

}  // namespace tripoint
