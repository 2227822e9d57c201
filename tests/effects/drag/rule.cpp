// SPDX-License-Identifier: BSD-3-Clause
#include "effects/drag/terms.hpp"
#include "scene/effect_rule.hpp"

namespace tripoint::drag {
namespace {

bool has_drag(const Material& m) { return value_of(m.values, "drag") > 0.0; }

std::string called_for(const Scene& s) {
  const auto drags = [](const Scene& scene, const Body& b, const Material& m) {
    return has_drag(m) && moves(scene, b);
  };
  return because(bodies_where(s, drags), "it moves through a gas that brakes it");
}

std::string left_out(const Scene& s) {
  return any_material(s, has_drag) ? "what has a drag is held in place" : "no material has a drag";
}

std::vector<EffectKey> keys() {
  return {{{"material", "drag", ValueType::number, "1/s", Range::not_negative, "0", "it moves in a vacuum",
            "", "share of the velocity that drag takes in a second"}}};
}

}  // namespace

EffectRule rule() {
  return {.name = "drag",
          .called_for = called_for,
          .left_out = left_out,
          .terms = {term::drag},
          .keys = keys(),
          .ledger_entries = {{"drag", "work that drag took"}}};
}

}  // namespace tripoint::drag
