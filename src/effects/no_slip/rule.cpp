// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/fixed_walls.hpp"

namespace tripoint::no_slip {
namespace {

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && liquid::mirrors_velocities(s) ? "liquid sticks to what is held or driven"
                                                                   : "";
}

}  // namespace

EffectRule rule() { return {.name = "no_slip", .called_for = called_for, .over_processes = true}; }

}  // namespace tripoint::no_slip
