// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/effect_rule.hpp"

namespace tripoint::heat_source {
namespace {

std::string called_for(const Scene& s) {
  const auto first = std::ranges::find_if(s.sources, [](const HeatSource& h) { return !h.is_of_surfaces(); });
  if (first == s.sources.end()) return "";
  return because("source " + std::to_string(first - s.sources.begin() + 1), "it heats matter from within");
}

std::string left_out(const Scene&) { return "no [[source]] gives heat to a volume"; }

}  // namespace

EffectRule rule() {
  return {.name = "heat_source",
          .called_for = called_for,
          .left_out = left_out,
          .ledger_entries = {{"heat_source", "minus the heat that sources gave to volumes"}},
          .over_processes = true};
}

}  // namespace tripoint::heat_source
