// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/read_case.hpp"
#include "scene/temperatures.hpp"

/// Why a scene does without an effect.
namespace tripoint {
namespace {

template <class Test>
bool any_body(const Scene& s, Test test) {
  return std::ranges::any_of(s.bodies, [&](const Body& b) { return test(b, s.material(b.material)); });
}

std::string why_no_fluid(const Scene& s) {
  if (any_body(s, [](const Body& b, const Material&) { return b.phase == Phase::liquid; })) return "every liquid is held in place, and nothing can touch";
  if (!s.contact) return "nothing is liquid, and the scene says contact = \"none\"";
  if (std::ranges::none_of(s.materials, [](const Material& m) { return m.stiffness.has_value(); })) return "nothing is liquid, no two bodies can meet before the end of the run, and no material has a stiffness";
  return "nothing is liquid, and no free body has another to touch";
}

std::string why_no_limit(const Scene& s, const char* none, bool given) {
  if (!given) return none;
  const bool moves = any_body(s, [](const Body& b, const Material&) { return b.phase == Phase::elastic; });
  return moves ? "the bodies that have a limit are held in place, or not elastic" : "nothing is elastic";
}

std::string why_no_heat(const Scene& s) {
  if (temperatures_of(s).empty()) return "no temperature is given";
  return "no body with a temperature has a conductivity and a heat_capacity";
}

/// The proof that nothing melts or freezes.
std::string why_no_phase(const Scene& s) {
  if (std::ranges::none_of(s.materials, [](const Material& m) { return m.t_melt.has_value(); })) return "no material has a t_melt";
  const TemperatureRange range = temperatures_of(s);
  if (range.empty()) return "no temperature is given";
  return fmt::format("bodies, inflows and events have {:.6g} to {:.6g} K, conduction never leaves that range, and no solid there melts and no liquid freezes", range.least,
                     range.greatest);
}

std::string why_not(const Scene& s, std::string_view effect) {
  const auto limited = [&](auto test) { return std::ranges::any_of(s.materials, test); };
  if (effect == "fluid") return why_no_fluid(s);
  if (effect == "elastic") return any_body(s, [](const Body& b, const Material&) { return b.phase == Phase::elastic; }) ? "what is elastic is held in place" : "nothing is elastic";
  if (effect == "plastic") return why_no_limit(s, "no material has an elastic_limit", limited([](const Material& m) { return m.elastic_limit.has_value(); }));
  if (effect == "fracture")
    return why_no_limit(s, "no material has a fracture limit", limited([](const Material& m) { return m.fracture_stretch || m.fracture_distance; }));
  if (effect == "rigid") return "nothing is rigid and moves";
  return effect == "heat" ? why_no_heat(s) : why_no_phase(s);
}

}  // namespace

std::vector<CalledEffect> idle_effects(const Scene& scene) {
  const auto called = called_effects(scene);
  std::vector<CalledEffect> idle;
  for (const char* name : {"fluid", "elastic", "plastic", "fracture", "rigid", "heat", "phase"})
    if (std::ranges::find(called, name, &CalledEffect::name) == called.end()) idle.push_back({name, why_not(scene, name)});
  return idle;
}

}  // namespace tripoint
