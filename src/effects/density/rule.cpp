// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::density {
namespace {

std::string needed_for(const Scene& s, const Called& called) {
  if (called("pressure")) return "pressure and viscosity divide by it";
  if (called("carried_liquid")) return "";  // it has a density
  const bool printed = s.mode_of(term::heat) == Mode::paper;
  return called("heat") && printed && !equal_temperature(s)
             ? "(21) as printed divides by the summed density (4)"
             : "";
}

}  // namespace

EffectRule rule() { return {.name = "density", .needed_for = needed_for, .over_processes = true}; }

}  // namespace tripoint::density
