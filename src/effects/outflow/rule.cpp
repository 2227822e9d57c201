// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::outflow {
namespace {

std::string called_for(const Scene& s) {
  if (s.removes_escaped) return because("scene.on_escape", "liquid that leaves the domain is dropped");
  return s.outflows.empty() ? "" : because("outflow 1", "liquid that comes in is dropped");
}

std::string left_out(const Scene&) { return "nothing leaves the scene"; }

}  // namespace

EffectRule rule() {
  return {.name = "outflow",
          .called_for = called_for,
          .left_out = left_out,
          .ledger_entries = {{"outflow", "energy that liquid took as it left"}}};
}

}  // namespace tripoint::outflow
