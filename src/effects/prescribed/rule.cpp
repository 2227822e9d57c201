// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/effect_rule.hpp"

namespace tripoint::prescribed {
namespace {

/// Whether an event holds or grips particles that are no members of rigid bodies for good.
bool moves_particles(const Scene& s) {
  const auto loose = [&](const std::string& name) { return s.body(name).phase != Phase::rigid; };
  return std::ranges::any_of(s.events, [&](const Event& e) {
    return e.kind == Event::Kind::grip ||
           (e.kind == Event::Kind::hold && std::ranges::any_of(e.bodies, loose));
  });
}

std::string needed_for(const Scene& s, const Called& called) {
  if (!called("motion")) return "";
  if (!s.inflows.empty()) return "an inflow brings particles in";
  return moves_particles(s) ? "a hold or a grip moves particles" : "";
}

}  // namespace

EffectRule rule() {
  return {.name = "prescribed",
          .needed_for = needed_for,
          .ledger_entries = {{"inflow", "minus the energy that inflows brought"}},
          .over_processes = true};
}

}  // namespace tripoint::prescribed
