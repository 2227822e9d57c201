// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"
#include "scene/ledger_entry.hpp"

namespace tripoint::motion {
namespace {

std::string needed_for(const Scene& s, const Called& called) {
  const bool moves = (s.has_liquid() && (called("pressure") || called("carried_liquid"))) ||
                     called("elastic") || called("phase");
  return moves ? "liquids and deformable solids move by the forces on their particles" : "";
}

}  // namespace

EffectRule rule() {
  return {.name = "motion",
          .needed_for = needed_for,
          .ledger_entries = {{ledger_entry::kinetic, "motion, of bodies with their spin"},
                             {ledger_entry::potential,
                              "height in gravity, against constant forces, and in springs"}},
          .over_processes = true};
}

}  // namespace tripoint::motion
