// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/read_case.hpp"
#include "scene/temperatures.hpp"

namespace tripoint {

double default_merge_distance(const Scene& s) { return s.mode_of(Term::phase) == Mode::paper ? 2.12 : 1.5; }

Scene scene_for(const Case& c, const RunChoice& choice) {
  Scene s = c.scene;
  if (choice.mode) s.mode = *choice.mode;
  for (std::size_t t = 0; t < term_count; ++t) s.modes[t] = s.modes_given[t].value_or(s.mode);
  if (choice.spacing) s.spacing = *choice.spacing;
  if (choice.time_step) s.time_step = *choice.time_step;
  if (choice.jitter) s.jitter = *choice.jitter;
  if (choice.seed) s.seed = *choice.seed;
  const bool paper = std::all_of(s.modes.begin(), s.modes.end(), [](Mode m) { return m == Mode::paper; });
  if (choice.support_ratio) s.support_ratio = *choice.support_ratio, s.support_ratio_given = true;
  else if (!s.support_ratio_given) s.support_ratio = paper ? 2.12 : 2.6;
  if (!s.merge_distance_given) s.merge_distance = default_merge_distance(s);
  if (const auto stiffness = default_stiffness(s)) {
    for (Material& m : s.materials) m.stiffness = stiffness->value;
  }
  return s;
}

std::vector<int> body_rows(const Scene& s) {
  std::vector<int> rows;
  int next = 0;
  for (const auto& b : s.bodies) rows.push_back(b.phase == Phase::liquid ? -1 : next++);
  return rows;
}

namespace {

/// Names of the bodies that a test picks: "body a", "bodies a, b"; empty when it picks none.
template <class Test>
std::string bodies_where(const Scene& s, Test test) {
  std::vector<std::string> names;
  for (const auto& b : s.bodies)
    if (test(b, s.material(b.material))) names.push_back(b.name);
  if (names.empty()) return "";
  if (names.size() > 4) return fmt::format("{} bodies ({}, ...)", names.size(), names.front());
  return fmt::format("{} {}", names.size() == 1 ? "body" : "bodies", fmt::join(names, ", "));
}

/// A body that is held for good needs no equations of motion.
bool moves(const Body& b, const Scene& s) {
  if (b.motion != Motion::fixed) return true;
  return std::any_of(s.events.begin(), s.events.end(), [](const Event& e) { return e.kind == Event::Kind::release || e.kind == Event::Kind::grip; });
}

/// Bodies that can meet others: contact needs a stiffness, two bodies, or one that can break in two, and one of them free.
std::string bodies_that_touch(const Scene& s) {
  const bool stiff = std::any_of(s.materials.begin(), s.materials.end(), [](const Material& m) { return m.stiffness.has_value(); });
  const bool any_free = std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.motion == Motion::free; });
  const auto breaks = [&](const Body& b) {
    const Material& m = s.material(b.material);
    return b.phase == Phase::elastic && (m.fracture_stretch || m.fracture_distance);
  };
  if (!s.contact || !stiff || !any_free || (s.bodies.size() < 2 && std::none_of(s.bodies.begin(), s.bodies.end(), breaks))) return "";
  return bodies_where(s, [](const Body&, const Material&) { return true; });
}

}  // namespace

std::vector<CalledEffect> called_effects(const Scene& s) {
  std::vector<CalledEffect> out;
  const auto call = [&](const char* name, const std::string& who, const char* why) {
    if (!who.empty()) out.push_back({name, fmt::format("{}: {}", who, why)});
  };
  std::string liquid = bodies_where(s, [&](const Body& b, const Material&) { return b.phase == Phase::liquid && moves(b, s); });
  if (liquid.empty() && !s.inflows.empty()) liquid = "an inflow";
  call("fluid", liquid, "liquid, and not held in place");
  if (liquid.empty()) call("fluid", bodies_that_touch(s), "more than one body, one of them free, and a stiffness: they can touch");
  const auto elastic = [&](const Body& b) { return b.phase == Phase::elastic && moves(b, s); };
  call("elastic", bodies_where(s, [&](const Body& b, const Material&) { return elastic(b); }), "elastic, and not held in place");
  call("plastic", bodies_where(s, [&](const Body& b, const Material& m) { return elastic(b) && m.elastic_limit; }), "elastic with an elastic_limit: can yield");
  call("fracture", bodies_where(s, [&](const Body& b, const Material& m) { return elastic(b) && (m.fracture_stretch || m.fracture_distance); }), "elastic with a fracture limit: can break");
  call("rigid", bodies_where(s, [&](const Body& b, const Material&) { return b.phase == Phase::rigid && moves(b, s); }), "rigid, and not held in place");
  call("heat", bodies_where(s, has_heat), "a temperature is given, and the material conducts");
  const auto range = temperatures_of(s);
  const auto changes = [&](const Body& b, const Material& m) {
    if (!has_heat(b, m) || !m.t_melt || b.temperature_held) return false;
    if (b.phase == Phase::liquid) return range.least < *m.t_solid;
    const bool band = s.mode_of(Term::phase) == Mode::paper && b.phase == Phase::elastic;  // soft from t_solid on (Fig. 5)
    return range.greatest > (band ? *m.t_solid : *m.t_melt);
  };
  std::string changing = bodies_where(s, changes);
  const auto poured = [&](const Inflow& f) {
    const Material& m = s.material(f.material);
    return f.temperature && m.t_melt && m.conductivity && m.heat_capacity && range.least < *m.t_solid;
  };
  if (changing.empty() && std::any_of(s.inflows.begin(), s.inflows.end(), poured)) changing = "an inflow";
  call("phase", changing, "the scene's temperatures pass t_melt or t_solid of the material");
  if (changing.empty()) return out;
  const auto has = [&](std::string_view name) { return std::any_of(out.begin(), out.end(), [&](const CalledEffect& e) { return e.name == name; }); };
  const bool stiff = std::any_of(s.materials.begin(), s.materials.end(), [](const Material& m) { return m.stiffness.has_value(); });
  if (!has("fluid") && (stiff || s.gravity != Vec3{})) call("fluid", changing, "what melts flows");
  const auto freezes_elastic = [&](const Body& b, const Material& m) { return changes(b, m) && m.solid == "elastic" && m.young_modulus; };
  std::string elastic_later = bodies_where(s, freezes_elastic);
  const auto pours_elastic = [&](const Inflow& f) { return poured(f) && s.material(f.material).solid == "elastic" && s.material(f.material).young_modulus; };
  if (elastic_later.empty() && std::any_of(s.inflows.begin(), s.inflows.end(), pours_elastic)) elastic_later = "an inflow";
  if (!has("elastic")) call("elastic", elastic_later, "what freezes is elastic");
  const auto call_later = [&](const char* name, auto limited, const char* why) {
    std::string who = bodies_where(s, [&](const Body& b, const Material& m) { return freezes_elastic(b, m) && limited(m); });
    const auto pours = [&](const Inflow& f) { return pours_elastic(f) && limited(s.material(f.material)); };
    if (who.empty() && std::any_of(s.inflows.begin(), s.inflows.end(), pours)) who = "an inflow";
    if (!has(name)) call(name, who, why);
  };
  call_later("plastic", [](const Material& m) { return m.elastic_limit.has_value(); }, "what freezes can yield");
  call_later("fracture", [](const Material& m) { return m.fracture_stretch || m.fracture_distance; }, "what freezes can break");
  return out;
}

}  // namespace tripoint
