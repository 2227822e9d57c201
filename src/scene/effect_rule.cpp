// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "scene/ledger_entry.hpp"
#include "scene/phase_values.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"

namespace tripoint {
namespace {

/// Whether a body's temperatures take it through a change of phase.
bool changes_phase(const Scene& s, const Body& b, const Material& m) {
  if (!has_heat(b, m) || !m.t_melt || b.temperature_held) return false;
  const TemperatureRange range = temperatures_of(s);
  if (b.phase == Phase::liquid) return range.least < *m.t_solid;
  const bool band = (s.mode_of(term::phase) == Mode::paper && b.phase == Phase::elastic) ||
                    turns_elastic(s, m);  // soft from t_solid on (Fig. 5)
  return range.greatest > (band ? *m.t_solid : *m.t_melt);
}

bool freezes(const Scene& s, const Inflow& f) {
  const Material& m = s.material(f.material);
  return f.temperature && m.t_melt && m.conductivity && m.heat_capacity &&
         temperatures_of(s).least < *m.t_solid;
}

bool is_elastic_when_frozen(const Scene& s, const Material& m) {
  return (m.solid == SolidKind::elastic && m.young_modulus) || turns_elastic(s, m);
}

template <class Test>
std::string names_where(const Scene& s, Test test) {
  std::vector<std::string> names;
  for (const Body& b : s.bodies)
    if (test(b, s.material(b.material))) names.push_back(b.name);
  if (names.empty()) return "";
  if (names.size() > 4) return fmt::format("{} bodies ({}, ...)", names.size(), names.front());
  return fmt::format("{} {}", names.size() == 1 ? "body" : "bodies", fmt::join(names, ", "));
}

}  // namespace

std::string because(const std::string& who, std::string_view why) {
  return who.empty() ? "" : fmt::format("{}: {}", who, why);
}

std::string bodies_where(const Scene& s, BodyTest test) {
  return names_where(s, [&](const Body& b, const Material& m) { return test(s, b, m); });
}

bool any_body(const Scene& s, BodyTest test) {
  return std::ranges::any_of(s.bodies, [&](const Body& b) { return test(s, b, s.material(b.material)); });
}

bool any_material(const Scene& s, bool (*test)(const Material&)) {
  return std::ranges::any_of(s.materials, test);
}

std::string printed_among(const Scene& s, std::initializer_list<Term> terms) {
  for (const Term& one : terms)
    if (s.mode_of(one) != Mode::corrected) return fmt::format("{} is as printed", one.name);
  return "";
}

bool moves(const Scene& s, const Body& b) {
  if (b.motion != Motion::fixed) return true;
  return std::ranges::any_of(
      s.events, [](const Event& e) { return e.kind == Event::Kind::release || e.kind == Event::Kind::grip; });
}

std::string who_changes_phase(const Scene& s) {
  std::string who = bodies_where(s, changes_phase);
  if (who.empty() && std::ranges::any_of(s.inflows, [&](const Inflow& f) { return freezes(s, f); }))
    who = "an inflow";
  return who;
}

std::string who_freezes_elastic(const Scene& s, bool (*limited)(const Material&)) {
  std::string who = names_where(s, [&](const Body& b, const Material& m) {
    return changes_phase(s, b, m) && is_elastic_when_frozen(s, m) && limited(m);
  });
  const auto pours = [&](const Inflow& f) {
    return freezes(s, f) && is_elastic_when_frozen(s, s.material(f.material)) &&
           limited(s.material(f.material));
  };
  if (who.empty() && std::ranges::any_of(s.inflows, pours)) who = "an inflow";
  return who;
}

std::string limit_called_for(const Scene& s, bool (*limited)(const Material&), std::string_view limit,
                             std::string_view can) {
  const std::string who = names_where(s, [&](const Body& b, const Material& m) {
    return b.phase == Phase::elastic && moves(s, b) && limited(m);
  });
  if (!who.empty()) return because(who, fmt::format("elastic with {}: can {}", limit, can));
  return because(who_freezes_elastic(s, limited), fmt::format("what freezes can {}", can));
}

std::string limit_left_out(const Scene& s, bool (*limited)(const Material&), std::string_view limit) {
  if (!any_material(s, limited)) return fmt::format("no material has {}", limit);
  const bool elastic =
      any_body(s, [](const Scene&, const Body& b, const Material&) { return b.phase == Phase::elastic; });
  return elastic ? "the bodies that have a limit are held in place, or not elastic" : "nothing is elastic";
}

std::vector<CalledEffect> called_effects(const Scene& s) {
  std::vector<CalledEffect> list;
  for (const EffectRule& rule : effect_rules())
    if (const std::string why = rule.called_for ? rule.called_for(s) : ""; !why.empty())
      list.push_back({std::string(rule.name), why});
  return list;
}

std::vector<CalledEffect> idle_effects(const Scene& s) {
  std::vector<CalledEffect> list;
  for (const EffectRule& rule : effect_rules())
    if (rule.called_for && rule.left_out && rule.called_for(s).empty())
      list.push_back({std::string(rule.name), rule.left_out(s)});
  return list;
}

std::vector<LedgerEntry> ledger_entries() {
  std::vector<LedgerEntry> entries;
  for (const EffectRule& rule : effect_rules())
    for (const LedgerEntry& entry : rule.ledger_entries)
      if (const auto known = std::ranges::find(entries, entry.name, &LedgerEntry::name);
          known == entries.end())
        entries.push_back(entry);
      else if (known->holds.empty())
        known->holds = entry.holds;
  entries.push_back({"merging", "energy that merging bodies lost"});
  entries.push_back({"walls", "work that what is held, fixed or driven took from the scene"});
  entries.push_back({ledger_entry::time_integration, "what finite steps leave between work and energy"});
  return entries;
}

double kept_number(const EffectValues& values, const Key& row) {
  if (const auto at = values.find(row.name); at != values.end()) return at->second;
  double fallback = 0.0;
  std::from_chars(row.fallback.data(), row.fallback.data() + row.fallback.size(), fallback);
  return fallback;
}

double acting_number(const Scene& scene, std::string_view key) {
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& one : rule.keys)
      if (one.row.table == "scene" && one.row.name == key)
        return one.idle && !one.idle(scene).empty() ? 0.0 : kept_number(scene.values, one.row);
  throw std::logic_error(fmt::format("no effect brings the key scene.{}", key));
}

double bond_reach(const Scene& s) { return kept_number(s.values, key_row("scene", "bond_reach")); }

bool calls_for(const Scene& s, std::string_view effect) {
  const auto rule = std::ranges::find(effect_rules(), effect, &EffectRule::name);
  return rule != effect_rules().end() && rule->called_for && !rule->called_for(s).empty();
}

bool calls_for(const Scene& s, bool EffectRule::*says) {
  return std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
    return rule.*says && rule.called_for && !rule.called_for(s).empty();
  });
}

std::vector<CalledEffect> needed_effects(const Scene& s) {
  std::vector<CalledEffect> list = called_effects(s);
  for (const EffectRule& rule : effect_rules()) {
    const Called called(list);
    if (!rule.needed_for || called(rule.name)) continue;
    if (const std::string why = rule.needed_for(s, called); !why.empty())
      list.push_back({std::string(rule.name), why});
  }
  return list;
}

}  // namespace tripoint
