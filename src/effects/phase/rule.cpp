// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/effect_rule.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::phase {
namespace {

std::string called_for(const Scene& s) { return because(who_changes_phase(s), "the scene's temperatures pass t_melt or t_solid of the material"); }

/// The proof that nothing melts or freezes.
std::string left_out(const Scene& s) {
  if (!any_material(s, [](const Material& m) { return m.t_melt.has_value(); })) return "no material has a t_melt";
  const TemperatureRange range = temperatures_of(s);
  if (range.empty()) return "no temperature is given";
  return fmt::format("bodies, inflows and events have {:.6g} to {:.6g} K, conduction never leaves that range, and no solid there melts and no liquid freezes", range.least,
                     range.greatest);
}

}  // namespace

EffectRule rule() { return {"phase", called_for, left_out, nullptr, {Term::phase}}; }

}  // namespace tripoint::phase
