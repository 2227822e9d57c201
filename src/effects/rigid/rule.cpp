// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/effect_rule.hpp"
#include "scene/ledger_entry.hpp"

#include "effects/rigid/terms.hpp"

namespace tripoint::rigid {
namespace {

std::string called_for(const Scene& s) {
  return because(bodies_where(s, [](const Scene& scene, const Body& b,
                                    const Material&) { return b.phase == Phase::rigid && moves(scene, b); }),
                 "rigid, and not held in place");
}

std::string left_out(const Scene&) { return "nothing is rigid and moves"; }

std::string needed_for(const Scene& s, const Called& called) {
  const auto driven = [](const Scene&, const Body& b, const Material&) {
    return b.phase == Phase::rigid || (b.phase == Phase::elastic && b.motion != Motion::free);
  };
  if (any_body(s, driven)) return "fixed and prescribed bodies move as rigid ones";
  if (called("phase") &&
      any_material(s, [](const Material& m) { return m.t_melt && m.solid == SolidKind::rigid; }))
    return "what freezes becomes rigid";
  return "";
}

}  // namespace

EffectRule rule() {
  return {.name = "rigid",
          .called_for = called_for,
          .left_out = left_out,
          .needed_for = needed_for,
          .terms = {{term::rotation, {{"splitting", "of second order (20)"}}, TermKind::time}},
          .ledger_entries = {{ledger_entry::kinetic},
                             {ledger_entry::potential},
                             {"applied_force",
                              "minus the work of torques, of dampers, and of forces that begin or end"}},
          .over_processes = true};
}

}  // namespace tripoint::rigid
